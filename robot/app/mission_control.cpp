#include "robot/app/mission_control.h"

#include "common/core/log.h"

namespace kiln {
namespace {

CommandAck answer(const Command& command, AckOutcome outcome, std::string code = {},
                  std::string reason = {}) {
  CommandAck ack;
  ack.client_id = command.client_id;
  ack.nonce = command.nonce;
  ack.command = std::string(commandName(command.body));
  ack.outcome = outcome;
  ack.code = std::move(code);
  ack.reason = std::move(reason);
  return ack;
}

CommandAck done(const Command& command) { return answer(command, AckOutcome::Done); }

CommandAck fromResult(const Command& command, const Result<void>& result) {
  return result ? done(command)
                : answer(command, AckOutcome::Failed, "device", result.error().message);
}

const char* codeOf(ChangeStateOutcome outcome) {
  switch (outcome) {
    case ChangeStateOutcome::Ok:
      return "";
    case ChangeStateOutcome::Denied:
      return "denied";
    case ChangeStateOutcome::NoSuchState:
      return "no_such_state";
    case ChangeStateOutcome::NeedsArguments:
      return "needs_arguments";
    case ChangeStateOutcome::Moved:
      return "moved";
  }
  return "denied";
}

}  // namespace

void MissionControl::startMission(Stamp now) {
  mode_ = Mode::Autonomous;
  pause_reason_.clear();
  parts_.mission.start(now);
  logger("mission")->info("mission started");
}

void MissionControl::resumeMission(Stamp now) {
  mode_ = Mode::Autonomous;
  parts_.mission.machine().resume(now);
  logger("mission")->warn("mission resumed from its checkpoint");
}

std::optional<CommandAck> MissionControl::execute(const Authority::Accepted& accepted, Stamp now) {
  if (isSetpoint(accepted.command.body)) {
    executeSetpoint(accepted);
    return std::nullopt;
  }
  return executeDiscrete(accepted.command, now);
}

CommandAck MissionControl::executeDiscrete(const Command& command, Stamp now) {
  const CommandBody& body = command.body;
  if (std::holds_alternative<StartMission>(body)) {
    startMission(now);
    return done(command);
  }
  if (std::holds_alternative<Pause>(body)) {
    pause_reason_ = "paused by " + command.operator_name;
    parts_.mission.machine().pause(pause_reason_, now);
    return done(command);
  }
  if (std::holds_alternative<Resume>(body)) {
    if (const std::string lost = parts_.position_lost(); !lost.empty())
      return answer(command, AckOutcome::Refused, "position_lost",
                    lost + "; set the robot's pose on the map, drive by hand or call a reset");
    if (mode_ == Mode::Teleop) return setMode(command, before_teleop_, now);
    pause_reason_.clear();
    parts_.mission.machine().resume(now);
    return done(command);
  }
  if (const auto* change = std::get_if<ChangeState>(&body))
    return changeState(command, *change, now);
  if (const auto* mode = std::get_if<SetMode>(&body)) return setMode(command, mode->mode, now);
  if (const auto* clear = std::get_if<ClearStop>(&body)) {
    if (!parts_.stop.clear(clear->generation))
      return answer(command, AckOutcome::Refused, "newer_stop", "another STOP came; look again");
    stop_seen_ = false;
    logger("safety")->warn("STOP cleared by {}; nothing moves until told to",
                           command.operator_name);
    return done(command);
  }
  if (std::holds_alternative<ReleaseProtectiveStop>(body)) {
    logger("safety")->warn("protective stop released by {}", command.operator_name);
    return fromResult(command, parts_.arm_controller.releaseProtectiveStop());
  }
  if (std::holds_alternative<ResetRobot>(body)) {
    hold(now);
    return fromResult(command, parts_.arena.requestReset());
  }
  if (const auto* scale = std::get_if<SetSpeedScale>(&body)) {
    parts_.teleop.setSpeedScale(scale->scale);
    return done(command);
  }
  if (std::holds_alternative<CancelMacro>(body)) {
    parts_.macros.cancel("cancelled by " + command.operator_name);
    return done(command);
  }
  if (const auto* pose = std::get_if<SetPose>(&body)) {
    parts_.set_pose(pose->X_map_base);
    logger("localization")
        ->warn("{} set the pose: x {:.2f} m, y {:.2f} m, {:.0f} deg", command.operator_name,
               pose->X_map_base.x_m, pose->X_map_base.y_m, pose->X_map_base.yaw_rad * 180.0 / M_PI);
    return done(command);
  }
  if (const auto* nudge = std::get_if<NudgePlace>(&body)) {
    const auto moved = parts_.mission.nudgePlace(nudge->place, nudge->by);
    return moved ? done(command)
                 : answer(command, AckOutcome::Refused, "nudge", moved.error().message);
  }
  if (const auto* despite = std::get_if<ContinueDespite>(&body)) {
    const auto on = parts_.mission.continueDespite(despite->subject, command.operator_name, now);
    if (!on) return answer(command, AckOutcome::Refused, "nothing_objects", on.error().message);
    logger("mission")->warn("{} goes on despite the check of {}", command.operator_name,
                            despite->subject);
    return done(command);
  }
  if (const auto* alarm = std::get_if<AcknowledgeAlarm>(&body)) {
    if (parts_.alarms.acknowledge(alarm->id)) return done(command);
    return answer(command, AckOutcome::Refused, "no_such_alarm",
                  fmt::format("there is no alarm '{}' any more", alarm->id));
  }
  if (const auto* recording = std::get_if<SetRecording>(&body)) {
    if (!parts_.set_recording)
      return answer(command, AckOutcome::Refused, "no_recorder", "this robot has no recorder");
    parts_.set_recording(recording->on);
    return done(command);
  }
  return answer(command, AckOutcome::Refused, "unknown_command",
                "this robot does not know the command");
}

CommandAck MissionControl::changeState(const Command& command, const ChangeState& change,
                                       Stamp now) {
  const ChangeStateResult result =
      parts_.mission.machine().changeState(change, command.operator_name, now);
  if (result.outcome != ChangeStateOutcome::Ok) {
    return answer(command, AckOutcome::Refused, codeOf(result.outcome), result.reason);
  }
  logger("mission")->warn("{} forced {} -> {}", command.operator_name, change.from, change.to);
  return done(command);
}

CommandAck MissionControl::setMode(const Command& command, Mode mode, Stamp now) {
  if (mode == Mode::Teleop) {
    if (mode_ != Mode::Teleop) before_teleop_ = mode_;
    pause_reason_ = command.operator_name + " drives by hand";
    parts_.mission.machine().pause(pause_reason_, now);
    hold(now);
    mode_ = Mode::Teleop;
    return done(command);
  }
  if (mode == Mode::Autonomous || mode == Mode::None) {
    hold(now);
    mode_ = parts_.mission.machine().status(now).running ? Mode::Autonomous : Mode::None;
    pause_reason_.clear();
    parts_.mission.machine().resume(now);
    return done(command);
  }
  return answer(command, AckOutcome::Refused, "wrong_mode",
                "supervised mode needs confirm edges, which this mission does not have; choose "
                "autonomous or teleop");
}

void MissionControl::executeSetpoint(const Authority::Accepted& accepted) {
  const CommandBody& body = accepted.command.body;
  const bool macro_runs = parts_.macros.running();
  if (const auto* macro = std::get_if<HoldMacro>(&body)) {
    if (!macro->name.empty()) parts_.macros.hold(macro->name, macro->restart, accepted.received);
    return;
  }
  if (macro_runs) parts_.macros.cancel("cancelled: another control was touched");
  if (const auto* jog = std::get_if<JogBase>(&body)) {
    parts_.teleop.jogBase(*jog, accepted.received, accepted.speed_scale);
  } else if (const auto* arm = std::get_if<JogArm>(&body)) {
    const auto state = parts_.arm.state();
    if (state) {
      parts_.teleop.jogArm(*arm, state->q, parts_.pose(), accepted.received, accepted.speed_scale);
    }
  } else if (const auto* pump = std::get_if<HoldPump>(&body)) {
    parts_.teleop.holdPump(*pump, accepted.received);
  }
}

void MissionControl::hold(Stamp now) {
  parts_.macros.cancel("cancelled");
  parts_.teleop.releaseAll(now);
}

void MissionControl::onReleased(const std::vector<HoldKind>& kinds, Stamp now) {
  if (kinds.empty() || mode_ != Mode::Teleop) return;
  for (const HoldKind kind : kinds) {
    if (kind == HoldKind::Macro) parts_.macros.cancel("cancelled: released");
  }
  parts_.teleop.releaseAll(now);
}

void MissionControl::onLeaseLost(Stamp now) {
  if (mode_ == Mode::Teleop) hold(now);
}

void MissionControl::watchStop(Stamp now) {
  if (!parts_.stop.latched() || stop_seen_) return;
  stop_seen_ = true;
  pause_reason_ = "STOP by " + parts_.stop.source();
  parts_.mission.machine().pause(pause_reason_, now);
  hold(now);
  logger("safety")->error("{}; clear it from a station that holds the lease", pause_reason_);
}

void MissionControl::holdMission(const std::string& reason, Stamp now) {
  pause_reason_ = reason;
  parts_.mission.machine().pause(reason, now);
  logger("mission")->error("{}; the mission waits until an operator resumes it", reason);
}

void MissionControl::onReset(Stamp now) {
  hold(now);
  parts_.mission.onReset(now);
  logger("mission")->warn("reset: robot is back at its start, clock runs on");
}

void MissionControl::step(Stamp now, bool macro_held) {
  if (mode_ == Mode::Teleop && !parts_.stop.latched()) parts_.macros.poll(now, macro_held);
  parts_.mission.tick(
      now);  // in teleop and after STOP the machine is paused: it keeps books, and moves nothing
}

StatusWord MissionControl::word(Stamp now, bool checks_ok) const {
  if (parts_.stop.latched()) return StatusWord::Stopped;
  if (mode_ == Mode::Teleop) return StatusWord::Teleop;
  const FsmStatus fsm = parts_.mission.machine().status(now);
  if (fsm.running && fsm.paused) return StatusWord::Paused;
  if (fsm.running) return mode_ == Mode::Supervised ? StatusWord::Supervised : StatusWord::Auto;
  return checks_ok ? StatusWord::Ready : StatusWord::NotReady;
}

std::string MissionControl::reason() const { return pause_reason_; }

}  // namespace kiln
