#include "robot/missions/fire/states/park_arm.h"

#include "robot/missions/fire/states/finished.h"
#include "robot/missions/fire/states/nothing_found.h"
#include "robot/missions/fire/states/safe_stop.h"

namespace kiln {

void ParkArm::enter() {
  FireContext& c = context();
  c.pumpsOff(now());
  c.devices.arm.startJoints(RobotGeometry::radians(c.devices.robot.q_park_deg), now());
}

Transition ParkArm::execute() {
  FireContext& c = context();
  const SkillStatus arm = c.devices.arm.poll(now());
  display(arm.text);
  if (arm.phase == SkillPhase::Running) return stay();
  // Water was delivered or not; an arm that cannot fold does not change that.
  const std::string note =
      arm.phase == SkillPhase::Failed ? "arm not parked: " + arm.text : "arm parked";
  if (c.belief.anyExtinguished()) return transit<Finished>().because(note);
  return transit<NothingFound>().because(note);
}

}  // namespace kiln
