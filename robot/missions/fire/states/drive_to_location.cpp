#include "robot/missions/fire/states/drive_to_location.h"

#include <cmath>

#include "robot/missions/fire/place_route.h"
#include "robot/missions/fire/states/arm_blocked.h"
#include "robot/missions/fire/states/check_place.h"
#include "robot/missions/fire/states/drive_blocked.h"

namespace kiln {

void DriveToLocation::enter() {
  FireContext& c = context();
  const RobotGeometry& robot = c.devices.robot;
  const double radius_m =
      0.5 * std::hypot(robot.length_m, robot.width_m) + c.config.drive.clearance_m;
  const FireBelief& belief = c.belief;
  c.drive.start(routeToPlace(c.devices.arena, c.site, c.devices.pose(), belief.at_place,
                             belief.current_place, radius_m),
                now());
}

Transition DriveToLocation::execute() {
  FireContext& c = context();
  const SkillStatus drive = c.drive.poll(now());
  guard("Arm stowed", c.drive.stowed());
  display(c.place().name + ": " + drive.text);
  if (drive.phase == SkillPhase::Done) {
    c.belief.at_place = c.belief.current_place;
    c.belief.blocked_in_row = 0;
    return transit<CheckPlace>().because("before " + c.place().name);
  }
  if (drive.phase == SkillPhase::Failed && c.drive.armFailed())
    return transit<ArmBlocked>(drive.text, ArmBlocked::While::Stowing).because(drive.text);
  if (drive.phase == SkillPhase::Failed || toSeconds(timeInState()) > c.config.drive.time_limit_s)
    return transit<DriveBlocked>(drive.text).because(drive.text);
  return stay();
}

}  // namespace kiln
