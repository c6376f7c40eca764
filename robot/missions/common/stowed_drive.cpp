#include "robot/missions/common/stowed_drive.h"

namespace kiln {

StowedDrive::StowedDrive(const RobotGeometry& robot, BaseMotion& base, ArmMotion& arm,
                         const Arm& device, double tolerance_rad)
    : q_drive_(RobotGeometry::radians(robot.q_drive_deg)),
      base_(base),
      arm_(arm),
      device_(device),
      tolerance_rad_(tolerance_rad) {}

bool StowedDrive::stowed() const {
  const std::optional<ArmState> state = device_.state();
  return state && (state->q - q_drive_).cwiseAbs().maxCoeff() <= tolerance_rad_;
}

void StowedDrive::start(std::vector<Pose2> waypoints_map, Stamp now) {
  waypoints_ = std::move(waypoints_map);
  arm_failed_ = false;
  stage_ = Stage::Stowing;
  if (!stowed()) arm_.startJoints(q_drive_, now);
}

SkillStatus StowedDrive::poll(Stamp now) {
  if (stage_ == Stage::Idle) return {};
  if (stage_ == Stage::Ended) return ended_;
  if (stage_ == Stage::Stowing) {
    if (stowed()) {
      stage_ = Stage::Driving;
      base_.start(waypoints_, now);
      return {SkillPhase::Running, 0.0, "arm stowed, driving", {}};
    }
    SkillStatus arm = arm_.poll(now);
    if (arm.phase == SkillPhase::Running)
      return {SkillPhase::Running, 0.0, "stowing the arm: " + arm.text, {}};
    arm_failed_ = true;
    if (arm.phase == SkillPhase::Failed) return end(std::move(arm));
    return end({SkillPhase::Failed, 0.0, "the arm is not where its motion ended", "not_stowed"});
  }
  SkillStatus drive = base_.poll(now);
  return drive.phase == SkillPhase::Running ? drive : end(std::move(drive));
}

SkillStatus StowedDrive::end(SkillStatus status) {
  stage_ = Stage::Ended;
  ended_ = std::move(status);
  return ended_;
}

void StowedDrive::cancel() {
  if (stage_ == Stage::Stowing) arm_.cancel();
  if (stage_ == Stage::Driving) base_.cancel();
  stage_ = Stage::Idle;
}

}  // namespace kiln
