#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/core/clock.h"
#include "robot/control/base_controller.h"
#include "robot/safety/geofence.h"
#include "robot/scene/arena_map.h"
#include "robot/skills/corridor_guard.h"
#include "robot/skills/motion.h"

namespace kiln {

/// Drives the base along way-points in `map` (omnidirectional, heading interpolated), with
/// jerk-limited speed, and stops at the last one. Judges by `pose` (X_map_base, from odometry or
/// localisation), which may be noisy and may jump by centimetres: the reference runs along the path
/// by itself and waits when the base lags behind. Failure codes: geofence, in_collision (a
/// way-point line leads through a known box), blocked (something stands in the way and stays),
/// stuck, stopped, timeout, no_pose.
class DriveTo final : public BaseMotion {
 public:
  struct Config {
    double speed_mps = 1.0;
    double approach_speed_mps = 0.3;  ///< within approach_distance_m of the end
    double approach_distance_m = 0.6;
    double position_tolerance_m = 0.02;
    double yaw_tolerance_deg = 0.5;
    double position_gain = 1.2;    ///< 1/s
    double yaw_gain = 1.5;         ///< 1/s
    double corner_radius_m = 0.3;  ///< way-points are passed within this
    double timeout_factor = 3.0;   ///< of the expected duration
    double timeout_slack_s = 8.0;  ///< and this much more
    double accel_mps2 = 0.5;       ///< along the path and across it in corners
    double yaw_rate_radps = 0.5;
    double edge_speed_mps = 0.5;       ///< over the arena's edge: a jolt that the arm bears
    double edge_distance_m = 0.3;      ///< from the nearer wheel on
    double jerk_time_s = 0.25;         ///< ramp of the acceleration
    double max_correction_mps = 0.25;  ///< a jump of the pose asks for no more than this
    double max_correction_radps = 0.3;
    double slow_error_m = 0.15;  ///< from this lag on the reference slows down ...
    double wait_error_m = 0.45;  ///< ... and here it waits
    double settle_s = 0.2;       ///< within tolerance and at rest for this long
    double geofence_slack_m =
        0.2;  ///< way-points keep the fence, the driving base may pass it by this
    double stuck_window_s = 2.0;  ///< commanded against covered way over this time
    double stuck_ratio = 0.3;     ///< less of the commanded way than this is stuck
    CorridorGuard::Config guard;  ///< against the live cloud
    Geofence::Config fence;       ///< for the way-points; the controller holds the same
    void visit(ConfigArchive& a);
  };
  using PoseSource = std::function<Pose2()>;  ///< newest X_map_base
  /// @param robot  its footprint keeps clear of the arena's boxes and of the live cloud. All outlive it.
  DriveTo(Config config, const RobotGeometry& robot, const ArenaMap& arena, BaseController& base,
          PoseSource pose);
  ~DriveTo() override;
  /// From then on drives only where the live cloud is free. nullptr: as before.
  void setSurroundings(const Surroundings* surroundings);
  /// Refuses (Failed at the first poll) way-points outside the geofence.
  void start(std::vector<Pose2> waypoints_map, Stamp now) override;
  [[nodiscard]] SkillStatus poll(Stamp now) override;
  void cancel() override;  ///< base ramps to rest
  [[nodiscard]] const std::vector<Pose2>& waypoints() const;
  [[nodiscard]] int nextIndex() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
