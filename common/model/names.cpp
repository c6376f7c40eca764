#include "common/model/command.h"
#include "common/model/localization.h"
#include "common/model/sensor.h"
#include "common/model/status.h"

namespace kiln {

void PointCloud::reserve(std::size_t n) {
  x.reserve(n);
  y.reserve(n);
  z.reserve(n);
  intensity.reserve(n);
  ring.reserve(n);
  time_offset_s.reserve(n);
}

void PointCloud::push(float px, float py, float pz, std::uint8_t i, std::uint8_t r, float dt_s) {
  x.push_back(px);
  y.push_back(py);
  z.push_back(pz);
  intensity.push_back(i);
  ring.push_back(r);
  time_offset_s.push_back(dt_s);
}

std::string_view toString(StatusWord word) {
  switch (word) {
    case StatusWord::NoLink:
      return "NO LINK";
    case StatusWord::NotReady:
      return "NOT READY";
    case StatusWord::Ready:
      return "READY";
    case StatusWord::Auto:
      return "AUTO";
    case StatusWord::Supervised:
      return "SUPERVISED";
    case StatusWord::Teleop:
      return "TELEOP";
    case StatusWord::Paused:
      return "PAUSED";
    case StatusWord::Stopped:
      return "STOPPED";
  }
  return "?";
}

std::string_view toString(MissionPhase phase) {
  switch (phase) {
    case MissionPhase::Idle:
      return "idle";
    case MissionPhase::Waiting:
      return "waiting";
    case MissionPhase::Running:
      return "running";
    case MissionPhase::Held:
      return "held";
    case MissionPhase::Ended:
      return "ended";
  }
  return "?";
}

std::string_view toString(Mode mode) {
  switch (mode) {
    case Mode::None:
      return "none";
    case Mode::Autonomous:
      return "autonomous";
    case Mode::Supervised:
      return "supervised";
    case Mode::Teleop:
      return "teleop";
    case Mode::Stopped:
      return "stopped";
  }
  return "?";
}

std::string_view toString(LocalizationHealth health) {
  switch (health) {
    case LocalizationHealth::Good:
      return "good";
    case LocalizationHealth::Degraded:
      return "degraded";
    case LocalizationHealth::Lost:
      return "lost";
  }
  return "?";
}

std::string_view toString(ArmSafetyMode mode) {
  switch (mode) {
    case ArmSafetyMode::Normal:
      return "normal";
    case ArmSafetyMode::Reduced:
      return "reduced";
    case ArmSafetyMode::ProtectiveStop:
      return "protective stop";
    case ArmSafetyMode::EmergencyStop:
      return "emergency stop";
    case ArmSafetyMode::Fault:
      return "fault";
  }
  return "?";
}

namespace {
struct NameOf {
  std::string_view operator()(const AcquireLease&) const { return "acquire_lease"; }
  std::string_view operator()(const ReleaseLease&) const { return "release_lease"; }
  std::string_view operator()(const StartMission&) const { return "start_mission"; }
  std::string_view operator()(const Pause&) const { return "pause"; }
  std::string_view operator()(const Resume&) const { return "resume"; }
  std::string_view operator()(const ChangeState&) const { return "change_state"; }
  std::string_view operator()(const SetMode&) const { return "set_mode"; }
  std::string_view operator()(const ClearStop&) const { return "clear_stop"; }
  std::string_view operator()(const ReleaseProtectiveStop&) const {
    return "release_protective_stop";
  }
  std::string_view operator()(const ResetRobot&) const { return "reset"; }
  std::string_view operator()(const SetSpeedScale&) const { return "set_speed_scale"; }
  std::string_view operator()(const CancelMacro&) const { return "cancel_macro"; }
  std::string_view operator()(const AcknowledgeAlarm&) const { return "acknowledge_alarm"; }
  std::string_view operator()(const SetRecording&) const { return "set_recording"; }
  std::string_view operator()(const SetPose&) const { return "set_pose"; }
  std::string_view operator()(const MissionCommand& b) const { return b.name; }
  std::string_view operator()(const JogBase&) const { return "jog_base"; }
  std::string_view operator()(const JogArm&) const { return "jog_arm"; }
  std::string_view operator()(const HoldActuator&) const { return "hold_actuator"; }
  std::string_view operator()(const HoldMacro&) const { return "hold_macro"; }
  std::string_view operator()(const ReleaseAll&) const { return "release_all"; }
};
}  // namespace

std::string_view commandName(const CommandBody& body) { return std::visit(NameOf{}, body); }

bool isSetpoint(const CommandBody& body) {
  return std::holds_alternative<JogBase>(body) || std::holds_alternative<JogArm>(body) ||
         std::holds_alternative<HoldActuator>(body) || std::holds_alternative<HoldMacro>(body) ||
         std::holds_alternative<ReleaseAll>(body);
}

}  // namespace kiln
