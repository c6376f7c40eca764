#include "gui/models/command_model.h"

#include <algorithm>

namespace kiln::gui {

namespace {
/// Nonces of commands that never left the station come from the top half of the range, out of the
/// link's way.
constexpr std::uint64_t kFirstLocalNonce = std::uint64_t{1} << 63;
}  // namespace

QString toText(CommandState state) {
  if (state == CommandState::Unknown) return QStringLiteral("no answer");
  const auto text = toString(state);
  return QString::fromUtf8(text.data(), static_cast<int>(text.size()));
}

CommandModel::CommandModel(Link& link, QObject* parent)
    : Model(link, AgeLimits{}, parent), next_local_(kFirstLocalNonce) {
  connect(&link, &Link::command, this, &CommandModel::onUpdate);
}

std::uint64_t CommandModel::send(const CommandBody& body, const QString& label) {
  TrackedCommand command;
  command.nonce = link().send(body);
  const auto name = commandName(body);
  command.name = QString::fromUtf8(name.data(), static_cast<int>(name.size()));
  command.label = label;
  command.sent_station = stationNow();
  command.sent = link().robotNow().value_or(command.sent_station);
  if (command.nonce == 0) {
    command.nonce = next_local_++;
    command.state = CommandState::NotSent;
    command.reason = QStringLiteral("there is no link to the robot");
  }
  if (commands_.size() == kCapacity) commands_.pop_front();
  commands_.push_back(command);
  arrived(command.sent);
  emit progressed(command);
  return command.nonce;
}

const TrackedCommand* CommandModel::find(std::uint64_t nonce) const {
  const auto found = std::find_if(commands_.rbegin(), commands_.rend(),
                                  [&](const TrackedCommand& c) { return c.nonce == nonce; });
  return found == commands_.rend() ? nullptr : &*found;
}

void CommandModel::onUpdate(const CommandUpdate& update) {
  const auto found = std::find_if(commands_.rbegin(), commands_.rend(),
                                  [&](const TrackedCommand& c) { return c.nonce == update.nonce; });
  if (found == commands_.rend() || update.state == CommandState::Sent) return;
  if (found->ack_s < 0) found->ack_s = update.answered_after_s;
  found->state = update.state;
  found->code = QString::fromStdString(update.code);
  found->reason = QString::fromStdString(update.reason);
  touch();
  emit progressed(*found);
}

}  // namespace kiln::gui
