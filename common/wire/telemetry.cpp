#include "common/wire/telemetry.h"

#include "common/wire/arm_state.h"
#include "common/wire/geometry.h"
#include "common/wire/mission_fields.h"
#include "common/wire/proto_message.h"
#include "kiln/v1/telemetry.pb.h"

namespace kiln::wire {
namespace {

using wire::fromProto;
using wire::toProto;

constexpr std::size_t kMaxStatusBytes = 1u << 20;

void toProto(const Alarm& alarm, v1::Alarm& out) {
  out.set_id(alarm.id);
  out.set_level(static_cast<std::uint32_t>(alarm.level));
  out.set_text(validUtf8(alarm.text));
  out.set_action(validUtf8(alarm.action));
  out.set_since_ns(toNanoseconds(alarm.since));
  out.set_active(alarm.active);
  out.set_acknowledged(alarm.acknowledged);
}

Result<Alarm> fromProto(const v1::Alarm& in) {
  const auto level = toEnum(in.level(), AlarmLevel::Warning, "alarm level");
  if (!level) return tl::make_unexpected(level.error());
  return Alarm{
      in.id(),     *level,           in.text(), in.action(), stampFromNanoseconds(in.since_ns()),
      in.active(), in.acknowledged()};
}

void toProto(const LeaseStatus& lease, v1::LeaseStatus& out) {
  out.set_holder_client(lease.holder_client);
  out.set_holder_name(validUtf8(lease.holder_name));
  out.set_epoch(lease.epoch);
  out.set_expires_in_s(lease.expires_in_s);
  out.set_requested_by_client(lease.requested_by_client);
  out.set_requested_by_name(validUtf8(lease.requested_by_name));
  out.set_request_expires_in_s(lease.request_expires_in_s);
}

LeaseStatus fromProto(const v1::LeaseStatus& in) {
  return {in.holder_client(),       in.holder_name(),         in.epoch(),
          in.expires_in_s(),        in.requested_by_client(), in.requested_by_name(),
          in.request_expires_in_s()};
}

void toProto(const MacroStatus& macro, v1::MacroStatus& out) {
  out.set_running(macro.running);
  out.set_step(macro.step);
  out.set_steps(macro.steps);
  out.set_step_text(validUtf8(macro.step_text));
  out.set_progress(macro.progress);
  out.set_last_result(validUtf8(macro.last_result));
}

MacroStatus fromProto(const v1::MacroStatus& in) {
  return {in.running(), in.step(), in.steps(), in.step_text(), in.progress(), in.last_result()};
}

void toProto(const StopStatus& stop, v1::StopStatus& out) {
  out.set_latched(stop.latched);
  out.set_source(validUtf8(stop.source));
  out.set_since_ns(toNanoseconds(stop.since));
  out.set_generation(stop.generation);
  out.set_base_at_rest(stop.base_at_rest);
  out.set_arm_at_rest(stop.arm_at_rest);
  out.set_pumps_at_rest(stop.pumps_at_rest);
  out.set_standstill_proven(stop.standstill_proven);
}

StopStatus fromProto(const v1::StopStatus& in) {
  StopStatus stop;
  stop.latched = in.latched();
  stop.source = in.source();
  stop.since = stampFromNanoseconds(in.since_ns());
  stop.generation = in.generation();
  stop.base_at_rest = in.base_at_rest();
  stop.arm_at_rest = in.arm_at_rest();
  stop.pumps_at_rest = in.pumps_at_rest();
  stop.standstill_proven = in.standstill_proven();
  return stop;
}

void toProto(const RecordingStatus& recording, v1::RecordingStatus& out) {
  out.set_on(recording.on);
  out.set_file(validUtf8(recording.file));
  out.set_duration_s(recording.duration_s);
  out.set_bytes(recording.bytes);
  out.set_dropped(recording.dropped);
  out.set_disk_free_bytes(recording.disk_free_bytes);
  out.set_problem(validUtf8(recording.problem));
}

RecordingStatus fromProto(const v1::RecordingStatus& in) {
  return {in.on(),     in.file(), in.duration_s(), in.bytes(), in.dropped(), in.disk_free_bytes(),
          in.problem()};
}

void listsToProto(const RobotStatus& status, v1::RobotStatus& out) {
  for (const Check& check : status.checks) {
    v1::Check& row = *out.add_checks();
    row.set_name(check.name);
    row.set_ok(check.ok);
    row.set_detail(validUtf8(check.detail));
    row.set_action(validUtf8(check.action));
    row.set_warn(check.warn);
  }
  for (const double angle : status.wheel_steer_rad) out.add_wheel_steer_rad(angle);
  for (const Alarm& alarm : status.alarms) toProto(alarm, *out.add_alarms());
  for (const DropCount& drop : status.drops) {
    v1::DropCount& row = *out.add_drops();
    row.set_topic(drop.topic);
    row.set_dropped(drop.dropped);
  }
  for (const std::string& name : status.operators) out.add_operators(validUtf8(name));
  for (const MissionHold& hold : status.holds) {
    v1::MissionHold& row = *out.add_holds();
    row.set_reason(static_cast<std::uint32_t>(hold.reason));
    row.set_text(validUtf8(hold.text));
  }
  for (const Figure& figure : status.figures) toProto(figure, *out.add_figures());
}

Result<void> listsFromProto(const v1::RobotStatus& in, RobotStatus& status) {
  for (const v1::Check& row : in.checks())
    status.checks.push_back({row.name(), row.ok(), row.detail(), row.action(), row.warn()});
  if (auto ok = copyFixed(in.wheel_steer_rad(), status.wheel_steer_rad, "wheels"); !ok) return ok;
  for (const v1::Alarm& row : in.alarms()) {
    auto alarm = fromProto(row);
    if (!alarm) return tl::make_unexpected(alarm.error());
    status.alarms.push_back(std::move(*alarm));
  }
  for (const v1::DropCount& row : in.drops()) status.drops.push_back({row.topic(), row.dropped()});
  status.operators.assign(in.operators().begin(), in.operators().end());
  for (const v1::MissionHold& row : in.holds()) {
    const auto reason = toEnum(row.reason(), HoldReason::Restored, "hold reason");
    if (!reason) return tl::make_unexpected(reason.error());
    status.holds.push_back({*reason, row.text()});
  }
  if (in.figures_size() > kMaxFigures)
    return makeError(ErrorCode::InvalidInput, "robot status: {} figures are more than {}; dropped",
                     in.figures_size(), kMaxFigures);
  for (const v1::Figure& row : in.figures()) status.figures.push_back(fromProto(row));
  return {};
}

Result<void> enumsFromProto(const v1::RobotStatus& in, RobotStatus& status) {
  const auto environment = toEnum(in.environment(), Environment::Replay, "environment");
  if (!environment) return tl::make_unexpected(environment.error());
  const auto mode = toEnum(in.mode(), Mode::Stopped, "mode");
  if (!mode) return tl::make_unexpected(mode.error());
  const auto word = toEnum(in.word(), StatusWord::Stopped, "status word");
  if (!word) return tl::make_unexpected(word.error());
  const auto phase = toEnum(in.mission_phase(), MissionPhase::Ended, "mission phase");
  if (!phase) return tl::make_unexpected(phase.error());
  status.phase = *phase;
  status.environment = *environment;
  status.mode = *mode;
  status.word = *word;
  return {};
}

}  // namespace

std::string encode(const RobotStatus& status) {
  v1::RobotStatus out;
  out.set_stamp_ns(toNanoseconds(status.stamp));
  out.set_seq(status.seq);
  out.set_robot_name(status.robot_name);
  out.set_version(status.version);
  out.set_environment(static_cast<std::uint32_t>(status.environment));
  out.set_mode(static_cast<std::uint32_t>(status.mode));
  out.set_word(static_cast<std::uint32_t>(status.word));
  out.set_reason(validUtf8(status.reason));
  out.set_mission_phase(static_cast<std::uint32_t>(status.phase));
  toProto(status.lease, *out.mutable_lease());
  toProto(status.stop, *out.mutable_stop());
  toProto(status.X_map_base, *out.mutable_x_map_base());
  out.set_pose_age_s(status.pose_age_s);
  toProto(status.twist, *out.mutable_twist());
  toProto(status.arm, *out.mutable_arm());
  out.set_battery_v(status.battery_v);
  out.set_battery_a(status.battery_a);
  toProto(status.macro, *out.mutable_macro());
  toProto(status.recording, *out.mutable_recording());
  out.set_speed_scale(status.speed_scale);
  out.set_mission_elapsed_s(status.mission_elapsed_s);
  out.set_mission_limit_s(status.mission_limit_s);
  out.set_resets(status.resets);
  listsToProto(status, out);
  return serialise(out);
}

Result<RobotStatus> decodeRobotStatus(std::string_view bytes) {
  const auto in = parse<v1::RobotStatus>(bytes, kMaxStatusBytes, "robot status");
  if (!in) return tl::make_unexpected(in.error());
  RobotStatus status;
  if (auto ok = enumsFromProto(*in, status); !ok) return tl::make_unexpected(ok.error());
  auto arm = fromProto(in->arm());
  if (!arm) return tl::make_unexpected(arm.error());
  status.arm = *arm;
  if (auto ok = listsFromProto(*in, status); !ok) return tl::make_unexpected(ok.error());
  status.stamp = stampFromNanoseconds(in->stamp_ns());
  status.seq = in->seq();
  status.robot_name = in->robot_name();
  status.version = in->version();
  status.reason = in->reason();
  status.lease = fromProto(in->lease());
  status.stop = fromProto(in->stop());
  status.X_map_base = fromProto(in->x_map_base());
  status.pose_age_s = in->pose_age_s();
  status.twist = fromProto(in->twist());
  status.battery_v = in->battery_v();
  status.battery_a = in->battery_a();
  status.macro = fromProto(in->macro());
  status.recording = fromProto(in->recording());
  status.speed_scale = in->speed_scale();
  status.mission_elapsed_s = in->mission_elapsed_s();
  status.mission_limit_s = in->mission_limit_s();
  status.resets = in->resets();
  return status;
}

std::string encode(const std::vector<MacroInfo>& macros) {
  v1::MacroList out;
  for (const MacroInfo& macro : macros) {
    v1::MacroInfo& row = *out.add_macros();
    row.set_name(macro.name);
    row.set_doc(macro.doc);
    row.set_duration_s(macro.duration_s);
    row.set_start_condition(validUtf8(macro.start_condition));
    row.set_uses(validUtf8(macro.uses));
  }
  return serialise(out);
}

Result<std::vector<MacroInfo>> decodeMacros(std::string_view bytes) {
  const auto in = parse<v1::MacroList>(bytes, kMaxStatusBytes, "macro list");
  if (!in) return tl::make_unexpected(in.error());
  std::vector<MacroInfo> macros;
  for (const v1::MacroInfo& row : in->macros()) {
    macros.push_back({row.name(), row.doc(), row.duration_s(), row.start_condition(), row.uses()});
  }
  return macros;
}

std::string encode(const LogBatch& batch) {
  v1::LogBatch out;
  for (const LogLine& line : batch.lines) {
    v1::LogLine& row = *out.add_lines();
    row.set_stamp_ns(toNanoseconds(line.stamp));
    row.set_level(line.level);
    row.set_logger(line.logger);
    row.set_text(validUtf8(line.text));
  }
  out.set_dropped(batch.dropped);
  return serialise(out);
}

Result<LogBatch> decodeLogBatch(std::string_view bytes) {
  const auto in = parse<v1::LogBatch>(bytes, kMaxStatusBytes, "log batch");
  if (!in) return tl::make_unexpected(in.error());
  LogBatch batch;
  for (const v1::LogLine& row : in->lines()) {
    batch.lines.push_back(
        {stampFromNanoseconds(row.stamp_ns()), row.level(), row.logger(), row.text()});
  }
  batch.dropped = in->dropped();
  return batch;
}

}  // namespace kiln::wire
