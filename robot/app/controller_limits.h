#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/model/sensor.h"
#include "common/robot_model/robot_geometry.h"

namespace kiln {

struct RobotSettings;

/// One configured limit and what it must keep to.
struct LimitRow {
  std::string key;  ///< in robot.yaml, "base.max_speed_mps"
  double configured = 0.0;
  double allowed = 0.0;
  std::string unit;
  std::string because;    ///< where `allowed` comes from
  bool at_least = false;  ///< `configured` must not be below; else not above
  bool clamped = false;   ///< a lower layer holds it anyway: worth a look, not a refusal
  [[nodiscard]] bool kept() const;
  /// "base.max_speed_mps is 5 m/s, more than 4 m/s (hub motors)".
  [[nodiscard]] std::string text() const;
};

/// The limits of the controllers against the robot's physical ones, against what the safety rules
/// promise (stop deceleration, ages) and against each other. Fixed for the life of the process.
[[nodiscard]] std::vector<LimitRow> controllerLimits(const RobotSettings& settings,
                                                     const RobotGeometry& robot);

/// Whether what the devices report lies within the limits that the controllers hold: joints,
/// joint speeds, steering angles. Empty: it does.
[[nodiscard]] std::string reportedBeyondLimits(const RobotSettings& settings,
                                               const RobotGeometry& robot,
                                               const std::optional<ArmState>& arm,
                                               const std::optional<BaseState>& base);

}  // namespace kiln
