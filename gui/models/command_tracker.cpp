#include "gui/models/command_tracker.h"

#include <algorithm>

namespace kiln::gui {

namespace {
/// Nonces of commands that never left the station come from the top half of the range, out of the
/// link's way.
constexpr std::uint64_t kFirstLocalNonce = std::uint64_t{1} << 63;
}  // namespace

CommandPhase phaseOf(AckOutcome outcome) {
  switch (outcome) {
    case AckOutcome::Accepted:
      return CommandPhase::Accepted;
    case AckOutcome::Refused:
      return CommandPhase::Refused;
    case AckOutcome::Done:
      return CommandPhase::Done;
    case AckOutcome::Failed:
      return CommandPhase::Failed;
    case AckOutcome::Cancelled:
      return CommandPhase::Cancelled;
  }
  return CommandPhase::Unknown;
}

QString toText(CommandPhase phase) {
  switch (phase) {
    case CommandPhase::Sent:
      return QStringLiteral("sent");
    case CommandPhase::Accepted:
      return QStringLiteral("accepted");
    case CommandPhase::Refused:
      return QStringLiteral("refused");
    case CommandPhase::Done:
      return QStringLiteral("done");
    case CommandPhase::Failed:
      return QStringLiteral("failed");
    case CommandPhase::Cancelled:
      return QStringLiteral("cancelled");
    case CommandPhase::Unknown:
      return QStringLiteral("no answer");
    case CommandPhase::NotSent:
      return QStringLiteral("not sent");
  }
  return {};
}

CommandTracker::CommandTracker(Link& link, QObject* parent)
    : Model(link, AgeLimits{}, parent), next_local_(kFirstLocalNonce) {
  connect(&link, &Link::ack, this, &CommandTracker::onAck);
}

std::uint64_t CommandTracker::send(const CommandBody& body, const QString& label) {
  TrackedCommand command;
  command.nonce = link().send(body);
  const auto name = commandName(body);
  command.name = QString::fromUtf8(name.data(), static_cast<int>(name.size()));
  command.label = label;
  command.sent_station = stationNow();
  command.sent = link().robotNow().value_or(command.sent_station);
  if (command.nonce == 0) {
    command.nonce = next_local_++;
    command.phase = CommandPhase::NotSent;
    command.reason = QStringLiteral("there is no link to the robot");
  }
  if (commands_.size() == kCapacity) commands_.pop_front();
  commands_.push_back(command);
  arrived(command.sent);
  emit progressed(command);
  return command.nonce;
}

const TrackedCommand* CommandTracker::find(std::uint64_t nonce) const {
  const auto found = std::find_if(commands_.rbegin(), commands_.rend(),
                                  [&](const TrackedCommand& c) { return c.nonce == nonce; });
  return found == commands_.rend() ? nullptr : &*found;
}

void CommandTracker::expire() {
  for (TrackedCommand& command : commands_) {
    if (!command.open() || toSeconds(stationNow() - command.sent_station) < kAckLimit_s) continue;
    command.phase = CommandPhase::Unknown;
    command.reason =
        QStringLiteral("no answer within 1 s; look at the robot's state before you try again");
    touch();
    emit progressed(command);
  }
}

void CommandTracker::onAck(const CommandAck& ack) {
  if (ack.client_id != link().clientId().toStdString()) return;
  const auto found = std::find_if(commands_.rbegin(), commands_.rend(),
                                  [&](const TrackedCommand& c) { return c.nonce == ack.nonce; });
  if (found == commands_.rend()) return;
  if (found->ack_s < 0) found->ack_s = toSeconds(stationNow() - found->sent_station);
  found->phase = phaseOf(ack.outcome);
  found->code = QString::fromStdString(ack.code);
  found->reason = QString::fromStdString(ack.reason);
  touch();
  emit progressed(*found);
}

}  // namespace kiln::gui
