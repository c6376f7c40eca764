#include "robot/missions/fire/states/arm_blocked.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/arm_search.h"
#include "robot/missions/fire/states/next_location.h"
#include "robot/missions/fire/states/safe_stop.h"

namespace kiln {

void ArmBlocked::enter() {
  FireContext& c = context();
  c.pumpsOff(now());
  c.devices.arm.cancel();  // a Hold setpoint also clears the latched contact
  c.aim.reset();
  c.devices.arm.startBack(c.config.faults.back_off_s, now());
}

void ArmBlocked::arrive() {
  FireContext& c = context();
  ++c.belief.blocked_in_row;
  if (c.hasPlace()) ++c.place().arm_faults;
}

Transition ArmBlocked::execute() {
  FireContext& c = context();
  const SkillStatus arm = c.devices.arm.poll(now());
  display(why_ + "; withdrawing");
  const bool rested = toSeconds(timeInState()) >= c.config.faults.arm_rest_s;
  if (arm.phase == SkillPhase::Running || !rested) return stay();
  const int in_row = c.belief.blocked_in_row;
  if (in_row >= c.config.faults.max_blocked_in_row)
    return transit<SafeStop>().because(
        fmt::format("the arm was blocked {} times: {}", in_row, why_));
  const bool place_open = c.hasPlace() && !c.place().visited;
  if (place_open && when_ == While::Extended &&
      c.place().arm_faults <= c.config.faults.max_arm_faults)
    return transit<ArmSearch>().because("trying once more");
  if (place_open && c.place().arm_faults > c.config.faults.max_arm_faults)
    c.closePlace("arm blocked: " + why_);
  return transit<NextLocation>().because(why_);
}

}  // namespace kiln
