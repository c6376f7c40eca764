#include "robot/missions/wall/wall_state.h"

#include <fmt/format.h>

#include "common/model/status.h"
#include "robot/missions/wall/states/arm_stopped.h"
#include "robot/missions/wall/states/set_brick.h"
#include "robot/missions/wall/states/store_brick.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {
namespace {

template <class S, class... Args>
Transition interruptTo(WallContext& context, std::string why) {
  auto next = std::make_unique<S>();
  next->bindContext(context);
  return Transition{std::move(next)}.because(std::move(why));
}

}  // namespace

bool armIsReleased(const WallContext& context) {
  const std::optional<ArmState> arm = context.parts.arm_device.state();
  return !arm || ((arm->safety == ArmSafetyMode::Normal || arm->safety == ArmSafetyMode::Reduced) &&
                  arm->powered);
}

Transition wallInterrupt(WallContext& context, bool may_hold, Stamp now) {
  if (!armIsReleased(context)) {
    const ArmState arm = *context.parts.arm_device.state();
    return interruptTo<ArmStopped>(
        context, fmt::format("arm: {}", arm.powered ? toString(arm.safety) : "not powered"));
  }
  const double elapsed_s = context.parts.belief.elapsedS(now);
  if (elapsed_s >= context.config.limit_s)
    return interruptTo<WallGivenUp>(
        context, fmt::format("the mission clock of {:.0f} s has run out", context.config.limit_s));
  if (context.belief.held && !may_hold) {
    std::string why = context.belief.held->name + " hangs on the gripper";
    return context.belief.unloading() ? interruptTo<SetBrick>(context, std::move(why))
                                      : interruptTo<StoreBrick>(context, std::move(why));
  }
  return Transition{};
}

}  // namespace kiln
