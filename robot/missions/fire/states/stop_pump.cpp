#include "robot/missions/fire/states/stop_pump.h"

#include <fmt/format.h>

#include "robot/missions/fire/states/next_location.h"

namespace kiln {

void StopPump::enter() {
  FireContext& c = context();
  c.pumpsOff(now());
  FirePlace& place = c.place();
  place.extinguished =
      place.litres_est >= c.config.spray.delivered_share * c.config.spray.litres_per_fire;
  c.closePlace(fmt::format("sprayed {:.1f} l (est.)", place.litres_est));
}

Transition StopPump::execute() {
  FireContext& c = context();
  c.pumpsOff(now());
  const PumpTracking pumps = c.devices.pumps.tracking();
  const double off_a = c.config.spray.off_current_a;
  const bool off = pumps.current_a[0] < off_a && pumps.current_a[1] < off_a && !pumps.spraying;
  if (guard("Pumps have stopped", off,
            fmt::format("{:.1f} A, {:.1f} A", pumps.current_a[0], pumps.current_a[1]),
            toSeconds(now() - pumps.stamp)))
    return transit<NextLocation>().because(c.place().outcome);
  return stay();
}

}  // namespace kiln
