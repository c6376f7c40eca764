#include <algorithm>

#include <fmt/format.h>

#include "common/wire/fire/fire_view.h"
#include "gui/link/fake_robot.h"

/// What the fake robot accepts and refuses; the same rules and codes as the daemon's gate, in
/// brief.
namespace kiln::gui {

namespace {
FakeRobot::Ack refused(const char* code, std::string reason) {
  return {AckOutcome::Refused, code, std::move(reason)};
}
FakeRobot::Ack done() { return {AckOutcome::Done, "", ""}; }
}  // namespace

void FakeRobot::stop(const std::string& who) {
  if (stopped_) return;
  stopped_ = true;
  stop_source_ = "STOP by " + who;
  stop_since_ = now_;
  hand_duty_ = {};
  macro_.clear();
  jog_ = {};
  say(3, stop_source_);
}

FakeRobot::Ack FakeRobot::handle(const std::string& id, const std::string& name,
                                 const CommandBody& body) {
  if (const auto* acquire = std::get_if<AcquireLease>(&body)) {
    if (!holder_.empty() && holder_ != id && !acquire->take_over) {
      return refused("lease_held", holder_name_ + " has the lease: ask for it or take over");
    }
    holder_ = id;
    holder_name_ = name;
    ++epoch_;
    say(2, "lease to " + name);
    return done();
  }
  if (const auto* record = std::get_if<SetRecording>(&body)) {
    if (recording_ && !record->on) recorded_s_ = toSeconds(now_ - recording_since_);
    if (record->on && !recording_) recording_since_ = now_;
    recording_ = record->on;
    return done();
  }
  if (holder_ != id) return refused("no_lease", "needs the lease");
  if (std::holds_alternative<ReleaseLease>(body)) {
    holder_.clear();
    holder_name_.clear();
    return done();
  }
  return isSetpoint(body) ? handleSetpoint(body) : handleWithLease(body);
}

FakeRobot::Ack FakeRobot::handleWithLease(const CommandBody& body) {
  if (std::holds_alternative<ClearStop>(body)) {
    if (!stopped_) return refused("not_stopped", "no stop is latched");
    stopped_ = false;
    paused_ = running_;
    say(2, "stop cleared: paused, nothing moves by itself");
    return done();
  }
  if (std::holds_alternative<AcknowledgeAlarm>(body)) return done();
  if (const auto* pose = std::get_if<SetPose>(&body)) return setPose(*pose);
  if (const auto* command = std::get_if<MissionCommand>(&body)) {
    if (command->name == fire::kNudgePlace) return nudge(*command);
    if (stopped_) return refused("stopped", "a stop is latched: clear it first");
    return running_ ? done() : refused("not_running", "no mission runs");
  }
  if (stopped_) return refused("stopped", "a stop is latched: clear it first");
  if (std::holds_alternative<StartMission>(body)) {
    if (running_) return refused("wrong_state", "the mission runs already");
    startMission();
    return done();
  }
  if (std::holds_alternative<Pause>(body) || std::holds_alternative<Resume>(body)) {
    if (!running_) return refused("wrong_state", "no mission runs");
    paused_ = std::holds_alternative<Pause>(body);
    say(2, paused_ ? "paused into a safe pose" : "resumed");
    return done();
  }
  if (const auto* mode = std::get_if<SetMode>(&body)) {
    mode_ = mode->mode;
    jog_ = {};
    hand_duty_ = {};
    say(2, fmt::format("mode {}", toString(mode_)));
    return done();
  }
  if (const auto* speed = std::get_if<SetSpeedScale>(&body)) {
    speed_scale_ = std::clamp(speed->scale, 0.0, 1.0);
    return done();
  }
  if (const auto* change = std::get_if<ChangeState>(&body)) return changeState(*change);
  if (std::holds_alternative<ResetRobot>(body)) {
    pose_ = {};
    legs_.push_back({static_cast<int>(legs_.size()), {}});
    say(3, "reset: carried back to the start");
  }
  if (std::holds_alternative<CancelMacro>(body)) macro_.clear();
  return done();
}

FakeRobot::Ack FakeRobot::changeState(const ChangeState& change) {
  const auto to = std::find_if(info_.states.begin(), info_.states.end(),
                               [&](const FsmStateInfo& s) { return s.name == change.to; });
  if (to == info_.states.end()) return refused("no_such_state", "there is no state " + change.to);
  if (!to->enterable) return refused("needs_arguments", to->label + " " + to->not_enterable_reason);
  if (change.step != step_ || change.from != state_) {
    return refused("moved", "the robot has moved on to " + state_ + " meanwhile: look again");
  }
  enter(change.to, TransitionCause::Operator, holder_name_);
  running_ = !terminal_;
  const auto row = std::find_if(script_.begin(), script_.end(),
                                [&](const Scripted& r) { return r.state == change.to; });
  if (row != script_.end()) at_ = static_cast<std::size_t>(row - script_.begin());
  return done();
}

FakeRobot::Ack FakeRobot::handleSetpoint(const CommandBody& body) {
  if (std::holds_alternative<ReleaseAll>(body)) {
    jog_ = {};
    hand_duty_ = {};
    if (!macro_.empty()) macro_result_ = "cancelled: released";
    macro_.clear();
    return done();
  }
  if (stopped_) return refused("stopped", "a stop is latched: clear it first");
  if (mode_ != Mode::Teleop) return refused("wrong_mode", "needs Teleop mode");
  if (const auto* base = std::get_if<JogBase>(&body)) jog_ = base->twist;
  if (const auto* pump = std::get_if<HoldActuator>(&body))
    hand_duty_ = {pump->name == kPumpRight ? 0.0 : pump->value,
                  pump->name == kPumpLeft ? 0.0 : pump->value};
  if (const auto* arm = std::get_if<JogArm>(&body)) {
    if (arm->frame == JogFrame::Joint)
      q_ += arm->velocity * 0.04;
    else
      q_[0] += arm->velocity[1] * 0.04;
  }
  if (const auto* macro = std::get_if<HoldMacro>(&body)) {
    if (macro->restart) macro_progress_ = 0.0;
    macro_ = macro->name;
  }
  return done();
}

}  // namespace kiln::gui
