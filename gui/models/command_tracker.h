#pragma once

#include <QString>
#include <deque>

#include "gui/models/model.h"

namespace kiln::gui {

/// What became of a discrete command.
enum class CommandPhase : std::uint8_t {
  Sent,
  Accepted,
  Refused,
  Done,
  Failed,
  Cancelled,
  Unknown,
  NotSent
};
[[nodiscard]] CommandPhase phaseOf(AckOutcome outcome);
[[nodiscard]] QString toText(CommandPhase phase);  ///< "sent", "accepted", "refused", ...

struct TrackedCommand {
  std::uint64_t nonce = 0;
  QString name;   ///< "change_state"
  QString label;  ///< for the operator: "jump to Aim hose"
  Stamp sent;     ///< robot time as far as known, for the timeline; else station time
  Stamp sent_station;
  CommandPhase phase = CommandPhase::Sent;
  QString code;    ///< machine-readable reason
  QString reason;  ///< one sentence
  double ack_s = -1.0;
  [[nodiscard]] bool open() const { return phase == CommandPhase::Sent; }
  [[nodiscard]] bool bad() const {
    return phase == CommandPhase::Refused || phase == CommandPhase::Failed ||
           phase == CommandPhase::Unknown || phase == CommandPhase::NotSent;
  }
};

/// Sends discrete commands and follows each to its end. A command without an answer within 1 s is
/// Unknown, not failed: it may have been carried out. Nothing is ever sent twice.
class CommandTracker : public Model {
  Q_OBJECT
 public:
  static constexpr double kAckLimit_s = 1.0;
  static constexpr std::size_t kCapacity = 200;

  explicit CommandTracker(Link& link, QObject* parent = nullptr);
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
  /// Marks what got no answer in time. Called by StationModels; tests call it themselves.
  void expire();

 signals:
  void progressed(const kiln::gui::TrackedCommand& command);  ///< at once, on every change of phase

 private:
  void onAck(const CommandAck& ack);
  std::deque<TrackedCommand> commands_;
  std::uint64_t next_local_;
};

}  // namespace kiln::gui
