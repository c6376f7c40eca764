#include "robot/missions/wall/states/approach_stack.h"

#include "robot/missions/wall/states/locate_bricks.h"
#include "robot/missions/wall/states/wall_drive_blocked.h"

namespace kiln {

void ApproachStack::enter() {
  WallContext& c = context();
  const auto next = c.nextBrick();
  nothing_ = !next;
  if (next) c.drive.start({c.takingPose(*next)}, now());
}

Transition ApproachStack::execute() {
  WallContext& c = context();
  if (nothing_) return transit<LocateBricks>().because("it is not known from where to take");
  const SkillStatus drive = c.drive.poll(now());
  guard("Arm stowed", c.drive.stowed());
  display("up to the stack: " + drive.text);
  if (drive.phase == SkillPhase::Failed)
    return transit<WallDriveBlocked>(drive.text).because(drive.text);
  if (drive.phase != SkillPhase::Done) return stay();
  c.belief.drive_faults = 0;
  return transit<LocateBricks>().because("before the stack");
}

}  // namespace kiln
