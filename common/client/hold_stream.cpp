#include "common/client/hold_stream.h"

#include <algorithm>

namespace kiln {
namespace {

constexpr int kZeros = 3;

std::optional<std::size_t> slotOf(const CommandBody& body) {
  if (std::holds_alternative<JogBase>(body)) return 0;
  if (std::holds_alternative<JogArm>(body)) return 1;
  if (std::holds_alternative<HoldActuator>(body)) return 2;
  if (std::holds_alternative<HoldMacro>(body)) return 3;
  return std::nullopt;
}

CommandBody zeroOf(const CommandBody& body) {
  if (const auto* jog = std::get_if<JogArm>(&body)) return JogArm{jog->frame, Vector6d::Zero()};
  if (const auto* actuator = std::get_if<HoldActuator>(&body)) return HoldActuator{actuator->name};
  if (std::holds_alternative<HoldMacro>(body)) return HoldMacro{};
  return JogBase{};
}

}  // namespace

void HoldStream::hold(CommandBody setpoint, std::uint64_t press, Monotonic::time_point now) {
  const auto index = slotOf(setpoint);
  if (!index) return;
  Slot& slot = slots_[*index];
  if (press <= slot.over) return;
  if (slot.held && press != slot.press) slot.over = slot.press;
  const bool same = slot.held && press == slot.press;
  slot.press = press;
  if (auto* macro = std::get_if<HoldMacro>(&setpoint); macro != nullptr && same) {
    const auto& before = std::get<HoldMacro>(slot.body);
    // A restart is meant once a press, not with each repetition; until it is sent it must not get
    // lost either.
    macro->restart = before.name == macro->name ? before.restart : macro->restart;
  }
  slot.body = std::move(setpoint);
  slot.refreshed = now;
  slot.held = true;
  slot.zeros_left = 0;
}

void HoldStream::release(const CommandBody& example) {
  const auto index = slotOf(example);
  if (!index || !slots_[*index].held) return;
  slots_[*index].held = false;
  slots_[*index].over = slots_[*index].press;
  slots_[*index].zeros_left = kZeros;
}

void HoldStream::releaseAll() {
  for (Slot& slot : slots_) {
    if (slot.held) release(slot.body);
  }
}

bool HoldStream::anyHeld() const {
  return std::any_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.held; });
}

bool HoldStream::active() const {
  return std::any_of(slots_.begin(), slots_.end(),
                     [](const Slot& s) { return s.held || s.zeros_left > 0; });
}

std::vector<HoldStream::Setpoint> HoldStream::due(Monotonic::time_point now) {
  for (Slot& slot : slots_) {
    if (slot.held && secondsBetween(slot.refreshed, now) > ttl_s_) release(slot.body);
  }
  // A little early is better than a period late: ticks are coarser than the period.
  if (!active() || (last_sent_ && secondsBetween(*last_sent_, now) < 0.9 * period_s_)) return {};
  last_sent_ = now;
  std::vector<Setpoint> out;
  const bool others_held = anyHeld();
  bool zeros = false;
  for (Slot& slot : slots_) {
    if (slot.held) {
      out.push_back({slot.body, slot.press});
      if (auto* macro = std::get_if<HoldMacro>(&slot.body)) macro->restart = false;
    } else if (slot.zeros_left > 0) {
      --slot.zeros_left;
      zeros = true;
      if (others_held) out.push_back({zeroOf(slot.body), 0});
    }
  }
  if (zeros && !others_held) out.push_back({ReleaseAll{}, 0});
  return out;
}

}  // namespace kiln
