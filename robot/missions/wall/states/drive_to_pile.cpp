#include "robot/missions/wall/states/drive_to_pile.h"

#include "robot/missions/wall/states/find_pile.h"
#include "robot/missions/wall/states/locate_bricks.h"
#include "robot/missions/wall/states/wall_drive_blocked.h"

namespace kiln {

void DriveToPile::enter() {
  WallContext& c = context();
  c.drive.start({c.pileLookPose(c.belief.pile_looks)}, now());
}

Transition DriveToPile::execute() {
  WallContext& c = context();
  const SkillStatus drive = c.drive.poll(now());
  guard("Arm stowed", c.drive.stowed());
  display("to the pile: " + drive.text);
  if (drive.phase == SkillPhase::Failed)
    return transit<WallDriveBlocked>(drive.text).because(drive.text);
  if (drive.phase != SkillPhase::Done) return stay();
  c.belief.drive_faults = 0;
  if (c.anyTaken()) return transit<LocateBricks>().because("before the pile");
  return transit<FindPile>().because("before the pile");
}

}  // namespace kiln
