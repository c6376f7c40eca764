#pragma once

#include <QString>
#include <deque>

#include "gui/models/model.h"

namespace kiln::gui {

/// For the operator: "no answer", else as toString(CommandState).
[[nodiscard]] QString toText(CommandState state);

struct TrackedCommand {
  std::uint64_t nonce = 0;
  QString name;   ///< "change_state"
  QString label;  ///< for the operator: "jump to Aim hose"
  Stamp sent;     ///< robot time as far as known, for the timeline; else station time
  Stamp sent_station;
  CommandState state = CommandState::Sent;
  QString code;    ///< machine-readable reason
  QString reason;  ///< one sentence
  double ack_s = -1.0;
  [[nodiscard]] bool open() const { return state == CommandState::Sent; }
  [[nodiscard]] bool bad() const {
    return state == CommandState::Refused || state == CommandState::Failed ||
           state == CommandState::Unknown || state == CommandState::NotSent;
  }
};

/// The discrete commands of this station and what became of each, as the link's tracker tells
/// (common/client/command_tracker.h).
class CommandModel : public Model {
  Q_OBJECT
 public:
  static constexpr std::size_t kCapacity = 200;

  explicit CommandModel(Link& link, QObject* parent = nullptr);
  /// @return the nonce to find the command by; entries without a link get one as well and are
  /// NotSent.
  std::uint64_t send(const CommandBody& body, const QString& label);
  [[nodiscard]] const std::deque<TrackedCommand>& commands() const {
    return commands_;
  }  ///< oldest first
  [[nodiscard]] const TrackedCommand* find(std::uint64_t nonce) const;
  [[nodiscard]] const TrackedCommand* newest() const {
    return commands_.empty() ? nullptr : &commands_.back();
  }

 signals:
  void progressed(const kiln::gui::TrackedCommand& command);  ///< at once, on every change of state

 private:
  void onUpdate(const CommandUpdate& update);
  std::deque<TrackedCommand> commands_;
  std::uint64_t next_local_;
};

}  // namespace kiln::gui
