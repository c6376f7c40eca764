#include "robot/missions/fire/states/spraying.h"

#include <fmt/format.h>

namespace kiln {

std::optional<std::string> keepSpraying(FireContext& context, Stamp now, Duration time_in_state) {
  context.pumpsOn(now);
  const PumpTracking pumps = context.devices.pumps.tracking();
  if (pumps.no_current)
    return fmt::format("no current: {:.1f} A, {:.1f} A", pumps.current_a[0], pumps.current_a[1]);
  const bool should_run = toSeconds(time_in_state) > context.config.spray.start_timeout_s;
  if (should_run && !pumps.spraying)
    return "the pumps do not run: " +
           (pumps.blocked.empty() ? std::string("no reason given") : pumps.blocked);
  return std::nullopt;
}

double sprayTimeLimit(const FireContext& context, double litres) {
  const FireSprayConfig& spray = context.config.spray;
  return spray.start_timeout_s + spray.phase_limit_factor * 60.0 * litres / spray.flow_lpm;
}

double steadyLitres(const FireContext& context) {
  return context.config.spray.steady_share * context.config.spray.litres_per_fire;
}

}  // namespace kiln
