#include "robot/missions/fire/states/time_nearly_over.h"

#include "robot/missions/fire/states/finished.h"
#include "robot/missions/fire/states/safe_stop.h"

namespace kiln {

void TimeNearlyOver::enter() {
  FireContext& c = context();
  c.haltAll(now());
  c.devices.arm.startJoints(RobotGeometry::radians(c.devices.robot.q_park_deg), now());
}

Transition TimeNearlyOver::execute() {
  FireContext& c = context();
  c.pumpsOff(now());
  display("parking the arm");
  const SkillStatus arm = c.devices.arm.poll(now());
  const bool late = toSeconds(timeInState()) >= c.config.clock.park_limit_s;
  if (arm.phase == SkillPhase::Running && !late) return stay();
  if (guard("A fire got its water", c.belief.anyExtinguished()))
    return transit<Finished>().because("time is over");
  return transit<SafeStop>().because("time is over and no fire was put out");
}

}  // namespace kiln
