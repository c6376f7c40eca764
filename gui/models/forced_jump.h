#pragma once

#include <QObject>
#include <QString>

#include "gui/models/station_models.h"

namespace kiln::gui {

/// The one way to force a transition: arm, pick a state, hold, and see what the robot said. Class C
/// of the confirmations: never one click, never modal; Esc or 5 s without a step cancel. The
/// command carries the state and the step that the operator looked at when picking, so that the
/// robot refuses it if it has moved on meanwhile.
class ForcedJump : public QObject {
  Q_OBJECT
 public:
  enum class Phase : std::uint8_t { Idle, Armed, Picked, Sent, Answered };
  static constexpr double kExpiry_s = 5.0;
  static constexpr double kAnswerShown_s = 6.0;

  explicit ForcedJump(StationModels& models, QObject* parent = nullptr);
  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] QString from() const { return from_; }
  [[nodiscard]] QString target() const { return target_; }
  /// What entering the target means, for the card.
  [[nodiscard]] QString consequence() const;
  /// One sentence on how it went: "accepted ...", "refused: ...", or why it was cancelled.
  [[nodiscard]] QString message() const { return message_; }
  [[nodiscard]] bool failed() const { return failed_; }
  /// Seconds until it expires; 0 when nothing is pending.
  [[nodiscard]] double leftS() const;
  /// Whether `name` may be picked now; if not, `why` gets the reason.
  [[nodiscard]] bool enterable(const QString& name, QString* why = nullptr) const;

  /// After the 1 s hold on "Arm forced jump". False (with message()) if the station may not
  /// command.
  bool arm();
  bool pick(const QString& name);
  /// After the 1 s hold on the card.
  void confirm();
  void cancel(const QString& reason = {});
  /// Looks at the clock; called at 5 Hz by itself.
  void tick();

 signals:
  void changed();

 private:
  void enter(Phase phase);
  void finish(const QString& message, bool failed);
  void onProgress(const TrackedCommand& command);
  StationModels& models_;
  Phase phase_ = Phase::Idle;
  Stamp since_;  ///< station time of the last step
  QString from_, target_, message_;
  std::uint64_t step_ = 0;
  std::uint64_t nonce_ = 0;
  bool failed_ = false;
};

}  // namespace kiln::gui
