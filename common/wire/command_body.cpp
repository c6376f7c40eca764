#include "common/wire/command_body.h"

#include "common/wire/geometry.h"
#include "common/wire/proto_message.h"

namespace kiln::wire {
namespace {

/// One overload a kind: a new alternative of CommandBody does not compile until it has a place
/// here.
struct BodyWriter {
  v1::Command& out;
  void operator()(const AcquireLease& b) const {
    out.mutable_acquire_lease()->set_take_over(b.take_over);
  }
  void operator()(const ReleaseLease&) const { out.mutable_release_lease(); }
  void operator()(const StartMission&) const { out.mutable_start_mission(); }
  void operator()(const Pause&) const { out.mutable_pause(); }
  void operator()(const Resume&) const { out.mutable_resume(); }
  void operator()(const ChangeState& b) const {
    out.mutable_change_state()->set_from(validUtf8(b.from));
    out.mutable_change_state()->set_step(b.step);
    out.mutable_change_state()->set_to(validUtf8(b.to));
  }
  void operator()(const SetMode& b) const { out.set_set_mode(static_cast<std::uint32_t>(b.mode)); }
  void operator()(const ClearStop& b) const {
    out.mutable_clear_stop()->set_generation(b.generation);
  }
  void operator()(const ReleaseProtectiveStop&) const { out.mutable_release_protective_stop(); }
  void operator()(const ResetRobot&) const { out.mutable_reset(); }
  void operator()(const SetSpeedScale& b) const { out.set_set_speed_scale(b.scale); }
  void operator()(const CancelMacro&) const { out.mutable_cancel_macro(); }
  void operator()(const AcknowledgeAlarm& b) const { out.set_acknowledge_alarm(validUtf8(b.id)); }
  void operator()(const SetRecording& b) const { out.set_set_recording(b.on); }
  void operator()(const SetPose& b) const { toProto(b.X_map_base, *out.mutable_set_pose()); }
  void operator()(const MissionCommand& b) const {
    v1::MissionCommand& command = *out.mutable_mission_command();
    command.set_name(validUtf8(b.name));
    command.set_target(validUtf8(b.target));
    for (const MissionCommand::Argument& argument : b.arguments) {
      v1::Argument& row = *command.add_arguments();
      row.set_name(validUtf8(argument.name));
      row.set_value(argument.value);
    }
  }
  void operator()(const JogBase& b) const { toProto(b.twist, *out.mutable_jog_base()); }
  void operator()(const JogArm& b) const {
    out.mutable_jog_arm()->set_frame(static_cast<std::uint32_t>(b.frame));
    for (int i = 0; i < 6; ++i) out.mutable_jog_arm()->add_velocity(b.velocity[i]);
  }
  void operator()(const HoldActuator& b) const {
    out.mutable_hold_actuator()->set_name(validUtf8(b.name));
    out.mutable_hold_actuator()->set_value(b.value);
  }
  void operator()(const HoldMacro& b) const {
    out.mutable_hold_macro()->set_name(validUtf8(b.name));
    out.mutable_hold_macro()->set_restart(b.restart);
  }
  void operator()(const ReleaseAll&) const { out.mutable_release_all(); }
};

Result<CommandBody> jogArmFromProto(const v1::JogArm& in) {
  const auto frame = toEnum(in.frame(), JogFrame::Base, "jog frame");
  if (!frame) return tl::make_unexpected(frame.error());
  JogArm jog{*frame, {}};
  if (auto ok = copyFixed(in.velocity(), jog.velocity, "arm jog"); !ok)
    return tl::make_unexpected(ok.error());
  return jog;
}

Result<CommandBody> missionCommandFromProto(const v1::MissionCommand& in) {
  constexpr int kMostArguments = 32;
  if (in.arguments_size() > kMostArguments)
    return makeError(ErrorCode::InvalidInput, "command '{}' has {} arguments, at most {} are due",
                     printableName(in.name()), in.arguments_size(), kMostArguments);
  MissionCommand command{printableName(in.name()), printableName(in.target()), {}};
  for (const v1::Argument& row : in.arguments())
    command.arguments.push_back({printableName(row.name()), row.value()});
  return command;
}

Result<CommandBody> setModeFromProto(std::uint32_t number) {
  const auto mode = toEnum(number, Mode::Stopped, "mode");
  if (!mode) return tl::make_unexpected(mode.error());
  return SetMode{*mode};
}

}  // namespace

void bodyToProto(const CommandBody& body, v1::Command& out) { std::visit(BodyWriter{out}, body); }

Result<CommandBody> bodyFromProto(const v1::Command& in) {
  switch (in.body_case()) {
    case v1::Command::kAcquireLease:
      return AcquireLease{in.acquire_lease().take_over()};
    case v1::Command::kReleaseLease:
      return ReleaseLease{};
    case v1::Command::kStartMission:
      return StartMission{};
    case v1::Command::kPause:
      return Pause{};
    case v1::Command::kResume:
      return Resume{};
    case v1::Command::kChangeState:
      return ChangeState{printableName(in.change_state().from()), in.change_state().step(),
                         printableName(in.change_state().to())};
    case v1::Command::kSetMode:
      return setModeFromProto(in.set_mode());
    case v1::Command::kClearStop:
      return ClearStop{in.clear_stop().generation()};
    case v1::Command::kReleaseProtectiveStop:
      return ReleaseProtectiveStop{};
    case v1::Command::kReset:
      return ResetRobot{};
    case v1::Command::kSetSpeedScale:
      return SetSpeedScale{in.set_speed_scale()};
    case v1::Command::kCancelMacro:
      return CancelMacro{};
    case v1::Command::kAcknowledgeAlarm:
      return AcknowledgeAlarm{printableName(in.acknowledge_alarm())};
    case v1::Command::kSetRecording:
      return SetRecording{in.set_recording()};
    case v1::Command::kSetPose:
      return SetPose{fromProto(in.set_pose())};
    case v1::Command::kMissionCommand:
      return missionCommandFromProto(in.mission_command());
    case v1::Command::kJogBase:
      return JogBase{fromProto(in.jog_base())};
    case v1::Command::kJogArm:
      return jogArmFromProto(in.jog_arm());
    case v1::Command::kHoldActuator:
      return HoldActuator{printableName(in.hold_actuator().name()), in.hold_actuator().value()};
    case v1::Command::kHoldMacro:
      return HoldMacro{printableName(in.hold_macro().name()), in.hold_macro().restart()};
    case v1::Command::kReleaseAll:
      return ReleaseAll{};
    case v1::Command::BODY_NOT_SET:
      break;
  }
  return makeError(ErrorCode::InvalidInput,
                   "command {} of '{}' is of an unknown kind; do both ends run the same version?",
                   in.nonce(), printableName(in.client_id()));
}

}  // namespace kiln::wire
