#pragma once

#include <optional>

#include "common/model/sensor.h"
#include "robot/control/swerve_kinematics.h"

namespace kiln {

/// Integrates measured drive angles and steering into X_odom_base. A jump that no wheel can make (a
/// restarted device, NaN) is skipped and integration goes on from there. Thread-compatible.
class WheelOdometry {
 public:
  explicit WheelOdometry(double max_speed_mps = 8.0) : max_speed_mps_(max_speed_mps) {}
  void update(const SwerveKinematics& kinematics, const BaseState& state);
  void reset() { X_odom_base_ = {}; }
  [[nodiscard]] const Pose2& pose() const { return X_odom_base_; }
  [[nodiscard]] int skipped() const { return skipped_; }

 private:
  double max_speed_mps_;
  std::optional<BaseState> last_;
  Pose2 X_odom_base_;
  int skipped_ = 0;
};

[[nodiscard]] bool isFinite(const BaseState& state);

}  // namespace kiln
