#include "robot/missions/fire/states/enter_building.h"

#include "robot/missions/common/route.h"
#include "robot/missions/fire/states/arm_blocked.h"
#include "robot/missions/fire/states/drive_blocked.h"
#include "robot/missions/fire/states/next_location.h"

namespace kiln {

void EnterBuilding::enter() {
  FireContext& c = context();
  std::vector<Pose2> route;
  for (const GroundPoseConfig& way_point : c.devices.arena.entry_path)
    route.push_back(way_point.pose());
  c.belief.at_place = -1;
  c.drive.start(remaining(c.devices.arena.start.pose(), route, c.devices.pose()), now());
}

Transition EnterBuilding::execute() {
  FireContext& c = context();
  const SkillStatus drive = c.drive.poll(now());
  guard("Arm stowed", c.drive.stowed());
  display(drive.text);
  if (drive.phase == SkillPhase::Done) {
    c.belief.inside = true;
    c.belief.blocked_in_row = 0;
    return transit<NextLocation>().because("inside the building");
  }
  if (drive.phase == SkillPhase::Failed && c.drive.armFailed())
    return transit<ArmBlocked>(drive.text, ArmBlocked::While::Stowing).because(drive.text);
  if (drive.phase == SkillPhase::Failed || toSeconds(timeInState()) > c.config.drive.time_limit_s)
    return transit<DriveBlocked>(drive.text).because(drive.text);
  return stay();
}

}  // namespace kiln
