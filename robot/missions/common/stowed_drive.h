#pragma once

#include <vector>

#include "common/robot_model/robot_geometry.h"
#include "robot/hal/arm.h"
#include "robot/skills/motion.h"

namespace kiln {

/// Drives only with the arm in its drive pose: stows it first, then starts the base. The base never
/// moves with an extended arm. Confined to the mission thread.
class StowedDrive {
 public:
  StowedDrive(const RobotGeometry& robot, BaseMotion& base, ArmMotion& arm, const Arm& device,
              double tolerance_rad);

  void start(std::vector<Pose2> waypoints_map, Stamp now);
  /// Failed with the arm's or the base's reason; `armFailed()` tells which.
  [[nodiscard]] SkillStatus poll(Stamp now);
  void cancel();
  [[nodiscard]] bool armFailed() const { return arm_failed_; }
  [[nodiscard]] bool stowed() const;  ///< measured joints are at the drive pose

 private:
  enum class Stage { Idle, Stowing, Driving, Ended };
  [[nodiscard]] SkillStatus end(SkillStatus status);

  Vector6d q_drive_;
  BaseMotion& base_;
  ArmMotion& arm_;
  const Arm& device_;
  double tolerance_rad_;
  Stage stage_ = Stage::Idle;
  bool arm_failed_ = false;
  std::vector<Pose2> waypoints_;
  SkillStatus ended_;
};

}  // namespace kiln
