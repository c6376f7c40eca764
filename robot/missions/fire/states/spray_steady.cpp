#include "robot/missions/fire/states/spray_steady.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/aim_hose.h"
#include "robot/missions/fire/states/pump_fault.h"
#include "robot/missions/fire/states/spray_pattern.h"
#include "robot/missions/fire/states/spraying.h"
#include "robot/missions/fire/states/stop_pump.h"

namespace kiln {

double SpraySteady::timeLimit(const FireContext& context) {
  return sprayTimeLimit(context, steadyLitres(context));
}

std::string SpraySteady::denyEntry(const FireContext& context) {
  return context.atSprayPose() ? "" : "the arm is not at a spray pose; enter Aim hose first";
}

Transition SpraySteady::execute() {
  FireContext& c = context();
  if (const auto fault = keepSpraying(c, now(), timeInState()))
    return transit<PumpFault>().because(*fault);
  if (!guard("Arm at spray pose", c.atSprayPose()))
    return transit<AimHose>().because("the nozzle is not where it was aimed");
  const double litres = c.place().litres_est;
  display(fmt::format("{:.2f} of {:.2f} l (est.)", litres, steadyLitres(c)));
  if (guard("Phase 1 complete", litres >= steadyLitres(c), fmt::format("{:.2f} l (est.)", litres)))
    return transit<SprayPattern>().because(fmt::format("{:.2f} l (est.)", litres));
  return stay();
}

}  // namespace kiln
