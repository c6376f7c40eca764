#include "robot/app/mission_control.h"

#include "common/core/log.h"
#include "common/core/units.h"
#include "robot/app/preflight.h"
#include "robot/safety/gate_rules.h"

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

GateSituation MissionControl::situation(Stamp now) const {
  GateSituation found = parts_.situation(now);
  found.mode = parts_.host.mode();
  found.phase = parts_.host.phase();
  found.stop_latched = parts_.stop.latched();
  found.stop_generation = parts_.stop.generation();
  found.stop_source = parts_.stop.source();
  return found;
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
    parts_.host.start(now);
    return done(command);
  }
  if (std::holds_alternative<Pause>(body)) {
    parts_.host.hold(HoldReason::OperatorPause, "paused by " + command.operator_name, now);
    return done(command);
  }
  if (std::holds_alternative<Resume>(body)) {
    parts_.host.resume(now);
    return done(command);
  }
  if (const auto* change = std::get_if<ChangeState>(&body))
    return changeState(command, *change, now);
  if (const auto* mode = std::get_if<SetMode>(&body)) return setMode(command, mode->mode, now);
  if (const auto* clear = std::get_if<ClearStop>(&body)) {
    if (!parts_.host.clearStop(clear->generation, now)) {  // it came after the gate had looked
      const GateDecision newer = gate::refuseNewerStop();
      return answer(command, AckOutcome::Refused, newer.code, newer.reason);
    }
    logger("safety")->warn("STOP cleared by {}; nothing moves until told to",
                           command.operator_name);
    return done(command);
  }
  if (std::holds_alternative<ReleaseProtectiveStop>(body)) {
    logger("safety")->warn("protective stop released by {}", command.operator_name);
    return fromResult(command, parts_.arm_controller.releaseProtectiveStop());
  }
  if (std::holds_alternative<ResetRobot>(body)) {
    if (parts_.arena == nullptr)
      return answer(command, AckOutcome::Refused, "no_device",
                    "nobody here can carry the robot to its start");
    endHandWork(now);
    return fromResult(command, parts_.arena->requestReset());
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
               pose->X_map_base.x_m, pose->X_map_base.y_m, pose->X_map_base.yaw_rad / kDeg);
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
  const auto& asked = std::get<MissionCommand>(body);
  const auto obeyed = parts_.host.mission().command(asked, command.operator_name, now);
  if (!obeyed) return answer(command, AckOutcome::Refused, "mission", obeyed.error().message);
  logger("mission")->warn("{} by {}", commandName(body), command.operator_name);
  return done(command);
}

CommandAck MissionControl::changeState(const Command& command, const ChangeState& change,
                                       Stamp now) {
  const ChangeStateResult result = parts_.host.force(change, command.operator_name, now);
  if (result.outcome != ChangeStateOutcome::Ok) {
    return answer(command, AckOutcome::Refused, codeOf(result.outcome), result.reason);
  }
  logger("mission")->warn("{} forced {} -> {}", command.operator_name, change.from, change.to);
  return done(command);
}

CommandAck MissionControl::setMode(const Command& command, Mode mode, Stamp now) {
  if (mode == parts_.host.mode()) return done(command);  // a mission under way is not disturbed
  endHandWork(now);
  if (mode == Mode::Teleop)
    parts_.host.enterTeleop(command.operator_name, now);
  else
    parts_.host.leaveTeleop(command.operator_name, now);
  return done(command);
}

void MissionControl::executeSetpoint(const Authority::Accepted& accepted) {
  const CommandBody& body = accepted.command.body;
  const bool macro_runs = parts_.macros.running();
  if (const auto* macro = std::get_if<HoldMacro>(&body)) {
    if (macro->name.empty()) return;
    if (!macro_runs) {  // an actuator has one writer
      parts_.teleop.releaseAll(accepted.received);
      for (const HoldKind kind : {HoldKind::BaseJog, HoldKind::ArmJog, HoldKind::Actuator})
        parts_.authority.endHold(kind);
    }
    parts_.macros.hold(macro->name, macro->restart, accepted.received);
    if (!parts_.macros.running()) parts_.authority.endHold(HoldKind::Macro);
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
  } else if (const auto* actuator = std::get_if<HoldActuator>(&body)) {
    parts_.teleop.holdActuator(*actuator, accepted.received);
  }
}

/// Macros, jogs and pumps by hand end, and with them the presses that held them.
void MissionControl::endHandWork(Stamp now) {
  parts_.macros.cancel("cancelled");
  parts_.teleop.releaseAll(now);
  parts_.authority.invalidate();
}

void MissionControl::onReleased(const std::vector<HoldKind>& kinds, Stamp now) {
  if (parts_.host.mode() != Mode::Teleop) return;
  for (const HoldKind kind : kinds)
    if (kind == HoldKind::Macro) parts_.macros.release();
  parts_.teleop.releaseAll(now);
}

void MissionControl::onLeaseLost(Stamp now) {
  if (parts_.host.mode() == Mode::Autonomous) return;
  parts_.macros.cancel("cancelled: control was lost");
  parts_.teleop.releaseAll(now);
}

void MissionControl::observeStop(Stamp now) {
  if (!parts_.host.observeStop(now)) return;
  endHandWork(now);
  stop_log_.error("{}; clear it from a station that holds the lease", parts_.host.reason());
}

void MissionControl::checkPosition(const std::string& objection, Stamp now) {
  if (objection.empty() || parts_.host.phase() != MissionPhase::Running) return;
  parts_.host.hold(HoldReason::PositionLost, objection, now);
  logger("mission")->error("{}; the mission waits until an operator resumes it", objection);
}

void MissionControl::onReset(Stamp now) {
  observeStop(now);  // a STOP of this tick comes first: the state is entered held
  endHandWork(now);
  parts_.host.onReset(now);
  logger("mission")->warn("reset: robot is back at its start, clock runs on");
}

void MissionControl::step(Stamp now) {
  if (parts_.host.mode() == Mode::Teleop) {
    parts_.macros.poll(now, parts_.authority.held(HoldKind::Macro, now));
    if (!parts_.macros.running()) parts_.authority.endHold(HoldKind::Macro);
  }
  parts_.host.tick(now);
}

RobotStatus MissionControl::status(const RobotBelief& belief, std::vector<Check> checks,
                                   Stamp now) const {
  RobotStatus s;
  s.stamp = now;
  s.mode = parts_.host.mode();
  s.word = parts_.host.word(allOk(checks));
  s.reason = s.word == StatusWord::NotReady ? firstFailure(checks) : parts_.host.reason();
  s.phase = parts_.host.phase();
  s.holds = parts_.host.holds();
  s.checks = std::move(checks);
  s.lease = parts_.authority.lease(now);
  s.stop.latched = parts_.stop.latched();
  s.stop.source = parts_.stop.source();
  s.stop.since = parts_.stop.since();
  s.stop.generation = parts_.stop.generation();
  s.figures = parts_.host.mission().figures(now);
  s.macro = parts_.macros.status();
  s.speed_scale = parts_.teleop.speedScale();
  s.mission_elapsed_s = belief.elapsedS(now);
  s.mission_limit_s = parts_.host.mission().limitS();
  s.resets = belief.resets;
  s.alarms = parts_.alarms.list();
  return s;
}

}  // namespace kiln
