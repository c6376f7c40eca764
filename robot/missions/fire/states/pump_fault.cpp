#include "robot/missions/fire/states/pump_fault.h"

#include "robot/missions/fire/states/next_location.h"
#include "robot/missions/fire/states/safe_stop.h"
#include "robot/missions/fire/states/start_pump.h"

namespace kiln {

void PumpFault::enter() {
  FireContext& c = context();
  broken_ = c.devices.pumps.tracking().pump_no_current;
  c.pumpsOff(now());
}

void PumpFault::arrive() { ++context().place().pump_faults; }

Transition PumpFault::execute() {
  FireContext& c = context();
  c.pumpsOff(now());
  display("pumps off, resting");
  if (toSeconds(timeInState()) < c.config.faults.pump_rest_s) return stay();
  if (c.place().pump_faults <= c.config.faults.max_pump_faults)
    return transit<StartPump>().because("trying once more");
  auto& usable = c.belief.pump_usable;
  const bool other_works = (usable[0] && !broken_[0]) != (usable[1] && !broken_[1]);
  if (usable[0] && usable[1] && other_works) {
    usable = {!broken_[0], !broken_[1]};
    return transit<StartPump>().because(broken_[0] ? "with the right pump alone"
                                                   : "with the left pump alone");
  }
  c.closePlace("the pumps do not run");
  if (c.belief.nextPlace() >= 0) return transit<NextLocation>().because(c.place().outcome);
  return transit<SafeStop>().because(c.place().outcome);
}

}  // namespace kiln
