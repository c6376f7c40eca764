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
  ++c.world().blocked_in_row;
  if (c.hasPlace()) ++c.place().arm_faults;
  const auto X_base_flange = c.X_base_flange();
  if (!X_base_flange || c.config.faults.back_off_m <= 0.0) return;
  // Back along the viewing direction, away from what was in front of the head.
  Eigen::Isometry3d X_back = *X_base_flange;
  X_back.translation() -= c.config.faults.back_off_m * X_back.linear().col(2);
  c.devices.arm.startCartesian({X_back}, false, now());
}

Transition ArmBlocked::execute() {
  FireContext& c = context();
  const SkillStatus arm = c.devices.arm.poll(now());
  display(why_ + "; withdrawing");
  const bool rested = toSeconds(timeInState()) >= c.config.faults.arm_rest_s;
  if (arm.phase == SkillPhase::Running || !rested) return stay();
  const int in_row = c.world().blocked_in_row;
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
