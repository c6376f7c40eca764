#include "common/client/command_tracker.h"

#include <fmt/format.h>

namespace kiln {
namespace {

constexpr std::size_t kMaxPending = 256;

}  // namespace

CommandState stateOf(AckOutcome outcome) {
  switch (outcome) {
    case AckOutcome::Accepted:
      return CommandState::Accepted;
    case AckOutcome::Refused:
      return CommandState::Refused;
    case AckOutcome::Done:
      return CommandState::Done;
    case AckOutcome::Failed:
      return CommandState::Failed;
    case AckOutcome::Cancelled:
      return CommandState::Cancelled;
  }
  return CommandState::Unknown;
}

std::string_view toString(CommandState state) {
  switch (state) {
    case CommandState::Sent:
      return "sent";
    case CommandState::Accepted:
      return "accepted";
    case CommandState::Refused:
      return "refused";
    case CommandState::Done:
      return "done";
    case CommandState::Failed:
      return "failed";
    case CommandState::Cancelled:
      return "cancelled";
    case CommandState::Unknown:
      return "unknown";
    case CommandState::NotSent:
      return "not sent";
  }
  return "?";
}

CommandUpdate CommandTracker::sent(std::uint64_t nonce, const CommandBody& body,
                                   Monotonic::time_point now) {
  CommandUpdate update;
  update.nonce = nonce;
  update.command = commandName(body);
  pending_[nonce] = {update, now};
  if (pending_.size() > kMaxPending) pending_.erase(pending_.begin());
  return update;
}

CommandUpdate CommandTracker::answered(const CommandAck& ack, Monotonic::time_point now) {
  CommandUpdate update;
  const auto pending = pending_.find(ack.nonce);
  if (pending != pending_.end()) {
    update = pending->second.update;
    update.answered_after_s = secondsBetween(pending->second.sent, now);
  }
  update.nonce = ack.nonce;
  update.command = ack.command;
  update.state = stateOf(ack.outcome);
  update.code = ack.code;
  update.reason = ack.reason;
  update.lease_holder = ack.lease_holder;
  if (pending == pending_.end()) return update;
  if (update.state == CommandState::Accepted) {
    pending->second.update = update;  // its end is still to come
  } else {
    pending_.erase(pending);
  }
  return update;
}

std::vector<CommandUpdate> CommandTracker::expire(Monotonic::time_point now) {
  std::vector<CommandUpdate> expired;
  for (auto& [nonce, pending] : pending_) {
    if (pending.update.state != CommandState::Sent) continue;
    const double age_s = secondsBetween(pending.sent, now);
    if (age_s <= timeout_s_) continue;
    pending.update.state = CommandState::Unknown;
    pending.update.reason = fmt::format(
        "no answer within {:.1f} s: it may have been done or not; look before you "
        "give it again",
        timeout_s_);
    pending.update.answered_after_s = age_s;
    expired.push_back(pending.update);
  }
  return expired;
}

}  // namespace kiln
