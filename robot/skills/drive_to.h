#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/core/clock.h"
#include "robot/control/base_controller.h"
#include "robot/scene/arena_map.h"
#include "robot/skills/motion.h"

namespace kiln {

/// Drives the base along way-points in `map` (omnidirectional, heading interpolated), with jerk-limited speed, and
/// stops at the last one. Judges by `pose` (X_map_base, from odometry or localisation).
class DriveTo final : public BaseMotion {
 public:
  struct Config {
    double speed_mps = 1.0;
    double approach_speed_mps = 0.3;      ///< within approach_distance_m of the end
    double approach_distance_m = 0.6;
    double position_tolerance_m = 0.02;
    double yaw_tolerance_deg = 0.5;
    double position_gain = 1.2;           ///< 1/s
    double yaw_gain = 1.5;                ///< 1/s
    double corner_radius_m = 0.3;         ///< way-points are passed within this
    double timeout_factor = 3.0;          ///< of the expected duration
    void visit(ConfigArchive& a);
  };
  using PoseSource = std::function<Pose2()>;  ///< newest X_map_base
  DriveTo(Config config, const ArenaMap& arena, BaseController& base, PoseSource pose);
  ~DriveTo() override;
  /// Refuses (Failed at the first poll) way-points outside the geofence.
  void start(std::vector<Pose2> waypoints_map, Stamp now) override;
  [[nodiscard]] SkillStatus poll(Stamp now) override;
  void cancel() override;                 ///< base ramps to rest
  [[nodiscard]] const std::vector<Pose2>& waypoints() const;
  [[nodiscard]] int nextIndex() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
