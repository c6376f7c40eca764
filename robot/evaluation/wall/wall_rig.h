#pragma once

#include <functional>

#include "common/core/clock.h"
#include "robot/app/live_surroundings.h"
#include "robot/app/state_history.h"
#include "robot/control/arm_controller.h"
#include "robot/control/base_controller.h"
#include "robot/hal/lidar.h"
#include "robot/missions/wall/skills/lidar_sweep.h"
#include "robot/perception/cloud/self_filter.h"
#include "robot/skills/drive_to.h"
#include "robot/skills/move_arm.h"

namespace kiln {

/// What the rig works with: the robot's devices, whoever stands behind them.
struct WallRigDevices {
  Arm& arm;
  DriveBase& base;
  Lidar& lidar;
  const Clock& clock;
  /// Lets one control period pass: writes what was commanded, delivers what was measured.
  std::function<Result<void>()> step;
};

/// A robot in a world of the wall, without a mission: the daemon's own controllers, skills, scan
/// preparation and memory of what stands around, in its order, and wheel odometry for localisation.
/// Confined to one thread.
class WallRig {
 public:
  /// @param arena  outlives it; what the arm and the base plan with, and may be changed.
  WallRig(const RobotGeometry& robot, const ArenaMap& arena, WallRigDevices devices);
  ~WallRig();
  WallRig(const WallRig&) = delete;
  WallRig& operator=(const WallRig&) = delete;

  /// Sensors begin; waits for the first scans. Error: Timeout, no scan comes.
  [[nodiscard]] Result<void> begin();
  [[nodiscard]] Result<void> pass(double seconds);
  /// Error: Refused, with the skill's own words.
  [[nodiscard]] Result<void> driveTo(const Pose2& X_map_base);
  [[nodiscard]] Result<SweepCloud> sweep(const SweepMotion& motion);

  /// By the wheels, from where the arena says that the robot starts.
  [[nodiscard]] Pose2 pose() const;
  [[nodiscard]] Vector6d joints() const;
  [[nodiscard]] MoveArm& mover() { return mover_; }
  [[nodiscard]] const Clock& clock() const { return devices_.clock; }
  [[nodiscard]] const LiveSurroundings& surroundings() const { return surroundings_; }

 private:
  void prepare();
  /// Until the skill has ended. Error: Refused, its failure.
  [[nodiscard]] Result<void> finish(const std::function<SkillStatus(Stamp)>& poll, double limit_s);

  const RobotGeometry robot_;
  const ArenaMap& arena_;
  WallRigDevices devices_;
  StopLatch stop_;
  ArmController arm_;
  BaseController base_;
  MoveArm mover_;
  DriveTo drive_;
  StateHistory history_;
  SelfFilter self_filter_;
  LiveSurroundings::Config surroundings_config_;
  LiveSurroundings surroundings_;
  LidarSweep sweep_;
  PointCloudPtr scan_;
  std::function<SkillStatus(Stamp)> skill_;
  SkillStatus status_;
  int steps_ = 0;
};

}  // namespace kiln
