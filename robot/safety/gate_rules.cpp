#include "robot/safety/gate_rules.h"

namespace kiln::gate {
namespace {

GateDecision refuseStopped() {
  return refuse("stopped",
                "STOP is latched: nothing moves; clear it first (1 s hold, needs control)");
}

/// One overload a kind, so that a new command does not compile until somebody has decided when it
/// may pass.
struct SituationRule {
  const GateSituation& now;

  GateDecision operator()(const AcquireLease&) const { return {}; }
  GateDecision operator()(const ReleaseLease&) const { return {}; }
  GateDecision operator()(const StartMission&) const {
    if (now.stop_latched) return refuseStopped();
    if (now.mode == Mode::Teleop)
      return refuse("wrong_mode", "a mission does not start in Teleop; leave it first");
    if (live()) return refuse("already_running", "the mission is running already");
    if (!now.ready)
      return refuse("not_ready", fmt::format("the robot is not ready: {}", now.not_ready_reason));
    return {};
  }
  GateDecision operator()(const Pause&) const {
    if (now.stop_latched) return refuseStopped();
    if (!live() && now.phase != MissionPhase::Waiting)
      return refuse("not_running", "no mission is running; there is nothing to pause");
    return {};
  }
  GateDecision operator()(const Resume&) const {
    if (now.stop_latched) return refuseStopped();
    if (now.mode == Mode::Teleop)
      return refuse("wrong_mode", "the mission rests in Teleop; leave it, then resume");
    if (now.phase != MissionPhase::Held) return refuse("not_paused", "the mission is not paused");
    if (!now.position_lost.empty())
      return refuse(
          "position_lost",
          now.position_lost + "; set the robot's pose on the map, drive by hand or call a reset");
    return {};
  }
  GateDecision operator()(const ChangeState&) const {
    return now.stop_latched ? refuseStopped() : GateDecision{};
  }
  GateDecision operator()(const SetMode& b) const {
    if (b.mode != Mode::Autonomous && b.mode != Mode::Teleop)
      return refuse("out_of_range",
                    "only Autonomous and Teleop can be chosen; STOP has its own lane");
    return now.stop_latched ? refuseStopped() : GateDecision{};
  }
  GateDecision operator()(const ClearStop& b) const {
    if (!now.stop_latched) return refuse("not_stopped", "no STOP is latched");
    if (b.generation != now.stop_generation) return refuseNewerStop();
    if (now.anything_held)
      return refuse("still_held", "a jog, pump or macro is still held; let go, then clear");
    return {};
  }
  GateDecision operator()(const ReleaseProtectiveStop&) const {
    if (!now.protective_stop)
      return refuse("no_protective_stop", "the arm is not in a protective stop");
    return {};
  }
  GateDecision operator()(const ResetRobot&) const {
    return {};
  }  // the referee may call one at any time
  GateDecision operator()(const SetSpeedScale&) const { return {}; }
  GateDecision operator()(const CancelMacro&) const { return {}; }
  GateDecision operator()(const AcknowledgeAlarm&) const { return {}; }
  GateDecision operator()(const SetRecording&) const { return {}; }
  GateDecision operator()(const SetPose&) const {
    if (now.phase == MissionPhase::Running) {
      return refuse("mission_running",
                    "the pose is not set under a running mission; pause it first");
    }
    if (now.base_moving)
      return refuse("moving", "the robot moves; wait for standstill, then set its pose");
    return {};
  }
  GateDecision operator()(const MissionCommand& b) const {
    const CommandSpec* spec = now.mission ? now.mission->command(b.name) : nullptr;
    if (now.stop_latched && !(spec && spec->while_stopped)) return refuseStopped();
    if (spec && spec->needs_live && !live())
      return refuse("not_running", "no mission is running; there is nothing to go on with");
    return {};
  }
  GateDecision operator()(const JogBase&) const { return byHand("jog"); }
  GateDecision operator()(const JogArm&) const {
    auto decision = byHand("jog");
    if (decision.accepted && now.protective_stop) return refuseProtective();
    return decision;
  }
  GateDecision operator()(const HoldActuator& b) const {
    return byHand((b.name + " by hand").c_str());
  }
  GateDecision operator()(const HoldMacro&) const {
    if (now.stop_latched) return refuseStopped();
    if (now.mode != Mode::Teleop) return wrongMode("macros", "Teleop");
    if (now.protective_stop) return refuseProtective();
    return {};
  }
  GateDecision operator()(const ReleaseAll&) const { return {}; }

 private:
  [[nodiscard]] bool live() const {
    return now.phase == MissionPhase::Running || now.phase == MissionPhase::Held;
  }
  GateDecision byHand(const char* what) const {
    if (now.stop_latched) return refuseStopped();
    if (now.mode != Mode::Teleop) return wrongMode(what, "Teleop");
    return {};
  }
  GateDecision wrongMode(const char* what, const char* where) const {
    return refuse("wrong_mode",
                  fmt::format("the robot is in mode {}; {} only in {}: change the mode first",
                              toString(now.mode), what, where));
  }
  static GateDecision refuseProtective() {
    return refuse("protective_stop",
                  "the arm is in a protective stop; look, then release it on your word");
  }
};

}  // namespace

GateDecision refuse(std::string code, std::string reason) {
  return {false, std::move(code), std::move(reason), 0.0};
}

GateDecision refuseNewerStop() {
  return refuse("newer_stop",
                "another STOP has come since the one that you saw; look, then clear again");
}

bool needsLease(const CommandBody& body) {
  return !std::holds_alternative<AcquireLease>(body) &&
         !std::holds_alternative<ReleaseLease>(body) &&
         !std::holds_alternative<AcknowledgeAlarm>(body) &&
         !std::holds_alternative<SetRecording>(body);
}

GateDecision checkSituation(const CommandBody& body, const GateSituation& situation) {
  return std::visit(SituationRule{situation}, body);
}

}  // namespace kiln::gate
