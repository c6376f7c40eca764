#include "robot/missions/common/stowed_drive.h"

#include <utility>

#include "robot/missions/common/route.h"

namespace kiln {

StowedDrive::StowedDrive(const MissionParts& parts, double tolerance_rad)
    : parts_(parts),
      q_drive_(RobotGeometry::radians(parts.robot.q_drive_deg)),
      tolerance_rad_(tolerance_rad) {}

bool StowedDrive::stowed() const {
  const std::optional<ArmState> state = parts_.arm_device.state();
  return state && (state->q - q_drive_).cwiseAbs().maxCoeff() <= tolerance_rad_;
}

void StowedDrive::start(std::vector<Pose2> waypoints_map, Stamp now) {
  waypoints_ = std::move(waypoints_map);
  arm_failed_ = false;
  stage_ = Stage::Stowing;
  arm_moves_ = !stowed();
  if (arm_moves_) parts_.arm.startJoints(q_drive_, now);
}

SkillStatus StowedDrive::poll(Stamp now) {
  if (stage_ == Stage::Idle) return {};
  if (stage_ == Stage::Ended) return ended_;
  if (stage_ == Stage::Stowing) return pollArm(now);
  SkillStatus drive = parts_.base.poll(now);
  if (drive.phase == SkillPhase::Running) return drive;
  if (stage_ == Stage::RunUp && drive.phase == SkillPhase::Done)
    return begin(Stage::Driving, waypoints_, "taking a run-up", now);
  return end(std::move(drive));
}

/// The arm's motion is followed to its end: its last setpoints bring the joints to rest.
SkillStatus StowedDrive::pollArm(Stamp now) {
  if (arm_moves_) {
    SkillStatus arm = parts_.arm.poll(now);
    if (arm.phase == SkillPhase::Running)
      return {SkillPhase::Running, 0.0, "stowing the arm: " + arm.text, {}};
    arm_moves_ = false;
    arm_failed_ = arm.phase == SkillPhase::Failed;
    if (arm_failed_) return end(std::move(arm));
  }
  if (!stowed()) {
    arm_failed_ = true;
    return end({SkillPhase::Failed, 0.0, "the arm is not where its motion ended", "not_stowed"});
  }
  const Pose2 here = parts_.pose();
  const auto back = waypoints_.empty()
                        ? std::nullopt
                        : runUp(parts_.arena.approach, parts_.robot, here, waypoints_.back());
  if (back) return begin(Stage::RunUp, {*back}, "a wheel stands against the edge: backing up", now);
  return begin(Stage::Driving, waypoints_, "arm stowed, driving", now);
}

SkillStatus StowedDrive::begin(Stage stage, std::vector<Pose2> waypoints_map, const char* text,
                               Stamp now) {
  stage_ = stage;
  parts_.base.start(std::move(waypoints_map), now);
  return {SkillPhase::Running, 0.0, text, {}};
}

SkillStatus StowedDrive::end(SkillStatus status) {
  stage_ = Stage::Ended;
  ended_ = std::move(status);
  return ended_;
}

void StowedDrive::cancel() {
  if (stage_ == Stage::Stowing) parts_.arm.cancel();
  if (stage_ == Stage::RunUp || stage_ == Stage::Driving) parts_.base.cancel();
  stage_ = Stage::Idle;
}

}  // namespace kiln
