#include "robot/safety/dead_man.h"

#include <algorithm>

namespace kiln {
namespace {
constexpr std::size_t kMaxClients = 64;
}

std::string_view toString(HoldKind kind) {
  switch (kind) {
    case HoldKind::BaseJog:
      return "base jog";
    case HoldKind::ArmJog:
      return "arm jog";
    case HoldKind::Actuator:
      return "actuator";
    case HoldKind::Macro:
      return "macro";
  }
  return "?";
}

std::optional<HoldKind> holdKind(const CommandBody& body) {
  if (std::holds_alternative<JogBase>(body)) return HoldKind::BaseJog;
  if (std::holds_alternative<JogArm>(body)) return HoldKind::ArmJog;
  if (std::holds_alternative<HoldActuator>(body)) return HoldKind::Actuator;
  if (std::holds_alternative<HoldMacro>(body)) return HoldKind::Macro;
  return std::nullopt;
}

bool isRelease(const CommandBody& body) {
  if (std::holds_alternative<ReleaseAll>(body)) return true;
  if (const auto* jog = std::get_if<JogBase>(&body)) {
    return jog->twist.vx_mps == 0.0 && jog->twist.vy_mps == 0.0 && jog->twist.wz_radps == 0.0;
  }
  if (const auto* jog = std::get_if<JogArm>(&body)) return jog->velocity.isZero(0.0);
  if (const auto* actuator = std::get_if<HoldActuator>(&body)) return actuator->value == 0.0;
  if (const auto* macro = std::get_if<HoldMacro>(&body)) return macro->name.empty();
  return false;
}

void DeadMan::Config::visit(ConfigArchive& a) {
  a.field("timeout_s", timeout_s, "s", 0.05, 0.25, "a hold ends this long after its last setpoint");
}

DeadMan::Client& DeadMan::client(const std::string& id) {
  if (!clients_.contains(id) && clients_.size() >= kMaxClients)
    clients_.erase(std::min_element(
        clients_.begin(), clients_.end(),
        [](const auto& a, const auto& b) { return a.second.touched < b.second.touched; }));
  Client& found = clients_[id];
  found.touched = ++touches_;
  return found;
}

void DeadMan::expire(Stamp now) {
  for (std::size_t i = 0; i < kHoldKinds; ++i) {
    const auto kind = static_cast<HoldKind>(i);
    if (holds_[i].last && !held(kind, now)) end(kind);
  }
}

bool DeadMan::mayFeed(const Command& command) const {
  const auto kind = holdKind(command.body);
  if (!kind || command.press == 0) return isRelease(command.body);
  const auto known = clients_.find(command.client_id);
  return known == clients_.end() ||
         command.press > known->second.over[static_cast<std::size_t>(*kind)];
}

void DeadMan::feed(const Command& command, Stamp when) {
  if (std::holds_alternative<ReleaseAll>(command.body)) return releaseAll();
  const auto kind = holdKind(command.body);
  if (!kind) return;
  if (command.press == 0) return end(*kind);
  Client& sender = client(command.client_id);
  sender.newest = std::max(sender.newest, command.press);
  Hold& hold = holds_[static_cast<std::size_t>(*kind)];
  const bool same = hold.last && hold.client == command.client_id && hold.press == command.press;
  if (hold.last && !same) end(*kind);
  hold.last = same ? std::max(*hold.last, when) : when;
  hold.client = command.client_id;
  hold.press = command.press;
  hold.reported = false;
}

void DeadMan::refused(const Command& command, bool only_this_message) {
  const auto kind = holdKind(command.body);
  if (!kind || command.press == 0) return;
  Client& sender = client(command.client_id);
  sender.newest = std::max(sender.newest, command.press);
  const Hold& hold = holds_[static_cast<std::size_t>(*kind)];
  const bool holds = hold.last && hold.client == command.client_id && hold.press == command.press;
  if (holds && only_this_message) return;
  if (holds) return end(*kind);
  std::uint64_t& over = sender.over[static_cast<std::size_t>(*kind)];
  over = std::max(over, command.press);
}

void DeadMan::end(HoldKind kind) {
  Hold& hold = holds_[static_cast<std::size_t>(kind)];
  if (!hold.last) return;
  std::uint64_t& over = client(hold.client).over[static_cast<std::size_t>(kind)];
  over = std::max(over, hold.press);
  hold.last.reset();
}

void DeadMan::releaseAll() {
  for (std::size_t i = 0; i < kHoldKinds; ++i) end(static_cast<HoldKind>(i));
  for (auto& [id, known] : clients_) known.over.fill(known.newest);
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
    end(kind);
    holds_[i] = Hold{};
    released.push_back(kind);
  }
  return released;
}

}  // namespace kiln
