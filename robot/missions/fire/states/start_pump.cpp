#include "robot/missions/fire/states/start_pump.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/aim_hose.h"
#include "robot/missions/fire/states/pump_fault.h"
#include "robot/missions/fire/states/spray_steady.h"

namespace kiln {

Transition StartPump::execute() {
  FireContext& c = context();
  const FireSprayConfig& spray = c.config.spray;
  if (!guard("Arm at spray pose", c.atSprayPose()))
    return transit<AimHose>().because("the arm is not at its spray pose");
  const PumpTracking pumps = c.devices.pumps.tracking();
  const double age_s = toSeconds(now() - pumps.stamp);
  bool drawing = true;
  bool water = false;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!c.belief.pump_usable[i]) continue;
    drawing = drawing && pumps.duty[i] > 0.0 && pumps.current_a[i] >= spray.min_current_a;
    water = water || pumps.tank_l_est[i] >= spray.min_start_l;
  }
  if (!guard("Water left", water,
             fmt::format("{:.1f} l + {:.1f} l (est.)", pumps.tank_l_est[0], pumps.tank_l_est[1]),
             age_s))
    return transit<PumpFault>().because("the tanks are empty (est.)");
  guard("Pump draws current", drawing,
        fmt::format("{:.1f} A, {:.1f} A", pumps.current_a[0], pumps.current_a[1]), age_s);
  c.pumpsOn(now());
  display(pumps.blocked.empty() ? "pumps spin up" : pumps.blocked);
  if (pumps.no_current)
    return transit<PumpFault>().because(
        fmt::format("no current: {:.1f} A, {:.1f} A", pumps.current_a[0], pumps.current_a[1]));
  return drawing ? transit<SpraySteady>() : stay();
}

}  // namespace kiln
