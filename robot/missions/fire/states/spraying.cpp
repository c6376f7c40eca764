#include "robot/missions/fire/states/spraying.h"

#include <fmt/format.h>

namespace kiln {

std::optional<std::string> keepSpraying(FireContext& context, Stamp now, Duration time_in_state) {
  context.pumpsOn(now);
  const PumpTracking pumps = context.devices.pumps.tracking();
  if (pumps.no_current)
    return fmt::format("no current: {:.1f} A, {:.1f} A", pumps.current_a[0], pumps.current_a[1]);
  if (pumps.spraying || toSeconds(time_in_state) <= context.config.spray.start_timeout_s) {
    context.pumps_idle_since.reset();
    return std::nullopt;
  }
  // One late setpoint cuts the pumps for a moment; only pumps that stay off are a fault.
  if (!context.pumps_idle_since) context.pumps_idle_since = now;
  if (toSeconds(now - *context.pumps_idle_since) > context.config.spray.idle_fault_s)
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
