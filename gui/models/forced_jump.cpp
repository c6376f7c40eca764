#include "gui/models/forced_jump.h"

#include <algorithm>

namespace kiln::gui {

ForcedJump::ForcedJump(StationModels& models, QObject* parent) : QObject(parent), models_(models) {
  connect(&models_, &StationModels::aged, this, &ForcedJump::tick);
  connect(&models_.commands, &CommandModel::progressed, this, &ForcedJump::onProgress);
  connect(&models_.fsm, &FsmModel::stateEntered, this, [this](const QString& name) {
    if (phase_ == Phase::Picked && name != from_) {
      cancel(tr("the robot has moved on to %1: look again").arg(models_.fsm.label(name)));
    }
  });
}

QString ForcedJump::consequence() const {
  if (target_.isEmpty()) return {};
  if (const FsmEdgeInfo* edge = models_.fsm.edge(from_, target_);
      edge && !edge->consequence.empty()) {
    return QString::fromStdString(edge->consequence);
  }
  const FsmStateInfo* state = models_.fsm.state(target_);
  if (state && !state->doc.empty()) return QString::fromStdString(state->doc);
  return tr("outside the planned order; what %1 stored is lost").arg(models_.fsm.label(from_));
}

double ForcedJump::leftS() const {
  if (phase_ != Phase::Armed && phase_ != Phase::Picked) return 0.0;
  return std::max(0.0, kExpiry_s - toSeconds(models_.clock().now() - since_));
}

bool ForcedJump::enterable(const QString& name, QString* why) const {
  const auto refuse = [why](const QString& text) {
    if (why) *why = text;
    return false;
  };
  const FsmStateInfo* state = models_.fsm.state(name);
  if (!state) return refuse(tr("not a state of this mission"));
  if (!state->enterable) {
    return refuse(tr("cannot be entered by hand: %1")
                      .arg(QString::fromStdString(state->not_enterable_reason)));
  }
  if (name == models_.fsm.current()) return refuse(tr("is the current state"));
  return true;
}

bool ForcedJump::arm() {
  QString why;
  if (!models_.mayCommand(&why)) {
    finish(why, true);
    return false;
  }
  target_.clear();
  message_.clear();
  enter(Phase::Armed);
  return true;
}

bool ForcedJump::pick(const QString& name) {
  QString why;
  if (phase_ != Phase::Armed && phase_ != Phase::Picked) {
    if (!arm()) return false;
  }
  if (!enterable(name, &why)) {
    message_ = models_.fsm.label(name) + QStringLiteral(" ") + why;
    emit changed();
    return false;
  }
  from_ = models_.fsm.current();
  step_ = models_.fsm.status() ? models_.fsm.status()->step : 0;
  target_ = name;
  message_.clear();
  enter(Phase::Picked);
  return true;
}

void ForcedJump::confirm() {
  if (phase_ != Phase::Picked) return;
  QString why;
  if (!models_.mayCommand(&why)) return cancel(why);
  phase_ = Phase::Sent;
  since_ = models_.clock().now();
  message_ = tr("sent");
  nonce_ = models_.commands.send(ChangeState{from_.toStdString(), step_, target_.toStdString()},
                                 tr("jump to %1").arg(models_.fsm.label(target_)));
  if (const TrackedCommand* command = models_.commands.find(nonce_)) onProgress(*command);
  emit changed();
}

void ForcedJump::cancel(const QString& reason) {
  if (phase_ == Phase::Idle || phase_ == Phase::Sent) return;
  if (reason.isEmpty()) {
    message_.clear();
    enter(Phase::Idle);
  } else {
    finish(reason, true);
  }
}

void ForcedJump::tick() {
  const double since_s = toSeconds(models_.clock().now() - since_);
  if ((phase_ == Phase::Armed || phase_ == Phase::Picked)) {
    if (since_s >= kExpiry_s) return cancel(tr("no step for 5 s: disarmed"));
    emit changed();
  }
  if (phase_ == Phase::Answered && since_s >= kAnswerShown_s) {
    message_.clear();
    enter(Phase::Idle);
  }
}

void ForcedJump::enter(Phase phase) {
  phase_ = phase;
  since_ = models_.clock().now();
  failed_ = false;
  emit changed();
}

void ForcedJump::finish(const QString& message, bool failed) {
  phase_ = Phase::Answered;
  since_ = models_.clock().now();
  message_ = message;
  failed_ = failed;
  emit changed();
}

void ForcedJump::onProgress(const TrackedCommand& command) {
  if (command.nonce != nonce_ || (phase_ != Phase::Sent && phase_ != Phase::Answered) ||
      command.open())
    return;
  const QString text = command.reason.isEmpty()
                           ? toText(command.state)
                           : toText(command.state) + QStringLiteral(": ") + command.reason;
  finish(text, command.bad());
}

}  // namespace kiln::gui
