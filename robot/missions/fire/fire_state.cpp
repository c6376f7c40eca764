#include "robot/missions/fire/fire_state.h"

#include <fmt/format.h>

#include "common/model/status.h"
#include "robot/missions/fire/states/protective_stop.h"
#include "robot/missions/fire/states/time_nearly_over.h"

namespace kiln {
namespace {

template <class S>
Transition interruptTo(FireContext& context, std::string why) {
  auto next = std::make_unique<S>();
  next->bindContext(context);
  return Transition{std::move(next)}.because(std::move(why));
}

}  // namespace

bool armIsReleased(const FireContext& context) {
  const std::optional<ArmState> arm = context.devices.arm_device.state();
  return !arm || ((arm->safety == ArmSafetyMode::Normal || arm->safety == ArmSafetyMode::Reduced) &&
                  arm->powered);
}

Transition fireInterrupt(FireContext& context, Stamp now) {
  if (!armIsReleased(context)) {
    const ArmState arm = *context.devices.arm_device.state();
    return interruptTo<ProtectiveStop>(
        context, fmt::format("arm: {}", arm.powered ? toString(arm.safety) : "not powered"));
  }
  const FireClockConfig& clock = context.config.clock;
  const double elapsed_s = context.elapsedS(now);
  if (elapsed_s >= clock.limit_s - clock.wrap_up_s)
    return interruptTo<TimeNearlyOver>(
        context, fmt::format("{:.0f} s of {:.0f} s are over", elapsed_s, clock.limit_s));
  return Transition{};
}

}  // namespace kiln
