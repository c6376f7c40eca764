#include "robot/safety/dead_man.h"

#include <algorithm>

namespace kiln {

std::string_view toString(HoldKind kind) {
  switch (kind) {
    case HoldKind::BaseJog:
      return "base jog";
    case HoldKind::ArmJog:
      return "arm jog";
    case HoldKind::Pump:
      return "pump";
    case HoldKind::Macro:
      return "macro";
  }
  return "?";
}

std::optional<HoldKind> holdKind(const CommandBody& body) {
  if (std::holds_alternative<JogBase>(body)) return HoldKind::BaseJog;
  if (std::holds_alternative<JogArm>(body)) return HoldKind::ArmJog;
  if (std::holds_alternative<HoldPump>(body)) return HoldKind::Pump;
  if (std::holds_alternative<HoldMacro>(body)) return HoldKind::Macro;
  return std::nullopt;
}

bool isRelease(const CommandBody& body) {
  if (std::holds_alternative<ReleaseAll>(body)) return true;
  if (const auto* jog = std::get_if<JogBase>(&body)) {
    return jog->twist.vx_mps == 0.0 && jog->twist.vy_mps == 0.0 && jog->twist.wz_radps == 0.0;
  }
  if (const auto* jog = std::get_if<JogArm>(&body)) return jog->velocity.isZero(0.0);
  if (const auto* pump = std::get_if<HoldPump>(&body))
    return pump->left == 0.0 && pump->right == 0.0;
  if (const auto* macro = std::get_if<HoldMacro>(&body)) return macro->name.empty();
  return false;
}

void DeadMan::Config::visit(ConfigArchive& a) {
  a.field("timeout_s", timeout_s, "s", 0.05, 0.25, "a hold ends this long after its last setpoint");
}

void DeadMan::feed(const CommandBody& setpoint, Stamp when) {
  if (std::holds_alternative<ReleaseAll>(setpoint)) return releaseAll();
  const auto kind = holdKind(setpoint);
  if (!kind) return;
  Hold& hold = holds_[static_cast<std::size_t>(*kind)];
  if (isRelease(setpoint)) {
    hold.last.reset();
    return;
  }
  hold.last = hold.last ? std::max(*hold.last, when) : when;
  hold.reported = false;
}

void DeadMan::releaseAll() {
  for (Hold& hold : holds_) hold.last.reset();
}

bool DeadMan::held(HoldKind kind, Stamp now) const {
  const Hold& hold = holds_[static_cast<std::size_t>(kind)];
  return hold.last && now - *hold.last <= fromSeconds(config_.timeout_s);
}

bool DeadMan::anyHeld(Stamp now) const {
  for (std::size_t i = 0; i < kHoldKinds; ++i) {
    if (held(static_cast<HoldKind>(i), now)) return true;
  }
  return false;
}

std::vector<HoldKind> DeadMan::takeReleased(Stamp now) {
  std::vector<HoldKind> released;
  for (std::size_t i = 0; i < kHoldKinds; ++i) {
    const auto kind = static_cast<HoldKind>(i);
    if (holds_[i].reported || held(kind, now)) continue;
    holds_[i] = Hold{};
    released.push_back(kind);
  }
  return released;
}

}  // namespace kiln
