#include "common/wire/fsm.h"

#include "common/wire/proto_message.h"
#include "kiln/v1/fsm.pb.h"

namespace kiln::wire {
namespace {

constexpr std::size_t kMaxFsmBytes = 1u << 20;
constexpr int kMaxStates = 256;  // a graph that somebody is to read

void toProto(const FsmStateInfo& state, v1::FsmStateInfo& out) {
  out.set_name(state.name);
  out.set_label(state.label);
  out.set_group(state.group);
  out.set_doc(state.doc);
  out.set_terminal(state.terminal);
  out.set_success(state.success);
  out.set_enterable(state.enterable);
  out.set_not_enterable_reason(state.not_enterable_reason);
  out.set_time_limit_s(state.time_limit_s);
  out.set_timeout_target(state.timeout_target);
}

FsmStateInfo fromProto(const v1::FsmStateInfo& in) {
  FsmStateInfo state;
  state.name = in.name();
  state.label = in.label();
  state.group = in.group();
  state.doc = in.doc();
  state.terminal = in.terminal();
  state.success = in.success();
  state.enterable = in.enterable();
  state.not_enterable_reason = in.not_enterable_reason();
  state.time_limit_s = in.time_limit_s();
  state.timeout_target = in.timeout_target();
  return state;
}

void toProto(const FsmHistoryEntry& entry, v1::FsmHistoryEntry& out) {
  out.set_step(entry.step);
  out.set_state(entry.state);
  out.set_entered_ns(toNanoseconds(entry.entered));
  out.set_left_ns(toNanoseconds(entry.left));
  out.set_cause(static_cast<std::uint32_t>(entry.cause));
  out.set_note(validUtf8(entry.note));
}

Result<FsmHistoryEntry> fromProto(const v1::FsmHistoryEntry& in) {
  const auto cause = toEnum(in.cause(), TransitionCause::Start, "transition cause");
  if (!cause) return tl::make_unexpected(cause.error());
  return FsmHistoryEntry{in.step(),
                         in.state(),
                         stampFromNanoseconds(in.entered_ns()),
                         stampFromNanoseconds(in.left_ns()),
                         *cause,
                         in.note()};
}

}  // namespace

std::string encode(const FsmInfo& info) {
  v1::FsmInfo out;
  out.set_mission(info.mission);
  out.set_mission_uuid(info.mission_uuid);
  out.set_start_state(info.start_state);
  for (const FsmStateInfo& state : info.states) toProto(state, *out.add_states());
  for (const FsmEdgeInfo& edge : info.edges) {
    v1::FsmEdgeInfo& row = *out.add_edges();
    row.set_from(edge.from);
    row.set_to(edge.to);
    row.set_timeout(edge.timeout);
    row.set_consequence(edge.consequence);
  }
  return serialise(out);
}

Result<FsmInfo> decodeFsmInfo(std::string_view bytes) {
  const auto in = parse<v1::FsmInfo>(bytes, kMaxFsmBytes, "state graph");
  if (!in) return tl::make_unexpected(in.error());
  if (in->states_size() > kMaxStates)
    return makeError(ErrorCode::InvalidInput, "state graph: {} states are more than {}; dropped",
                     in->states_size(), kMaxStates);
  FsmInfo info;
  info.mission = in->mission();
  info.mission_uuid = in->mission_uuid();
  info.start_state = in->start_state();
  for (const v1::FsmStateInfo& row : in->states()) info.states.push_back(fromProto(row));
  for (const v1::FsmEdgeInfo& row : in->edges()) {
    info.edges.push_back({row.from(), row.to(), row.timeout(), row.consequence()});
  }
  return info;
}

std::string encode(const FsmStatus& status) {
  v1::FsmStatus out;
  out.set_stamp_ns(toNanoseconds(status.stamp));
  out.set_mission_uuid(status.mission_uuid);
  out.set_step(status.step);
  out.set_state(status.state);
  out.set_entered_ns(toNanoseconds(status.entered));
  out.set_running(status.running);
  out.set_paused(status.paused);
  out.set_terminal(status.terminal);
  out.set_success(status.success);
  out.set_display_text(validUtf8(status.display_text));
  for (const GuardStatus& guard : status.guards) {
    v1::GuardStatus& row = *out.add_guards();
    row.set_name(guard.name);
    row.set_met(guard.met);
    row.set_detail(validUtf8(guard.detail));
    row.set_input_age_s(guard.input_age_s);
  }
  for (const FsmHistoryEntry& entry : status.history) toProto(entry, *out.add_history());
  out.set_blocked(status.blocked);
  if (status.paused_in_state)
    out.set_paused_in_state_ns(
        std::chrono::duration_cast<std::chrono::nanoseconds>(*status.paused_in_state).count());
  return serialise(out);
}

Result<FsmStatus> decodeFsmStatus(std::string_view bytes) {
  const auto in = parse<v1::FsmStatus>(bytes, kMaxFsmBytes, "state status");
  if (!in) return tl::make_unexpected(in.error());
  FsmStatus status;
  status.stamp = stampFromNanoseconds(in->stamp_ns());
  status.mission_uuid = in->mission_uuid();
  status.step = in->step();
  status.state = in->state();
  status.entered = stampFromNanoseconds(in->entered_ns());
  status.running = in->running();
  status.paused = in->paused();
  status.terminal = in->terminal();
  status.success = in->success();
  status.display_text = in->display_text();
  for (const v1::GuardStatus& row : in->guards()) {
    status.guards.push_back({row.name(), row.met(), row.detail(), row.input_age_s()});
  }
  for (const v1::FsmHistoryEntry& row : in->history()) {
    auto entry = fromProto(row);
    if (!entry) return tl::make_unexpected(entry.error());
    status.history.push_back(std::move(*entry));
  }
  status.blocked = in->blocked();
  if (in->has_paused_in_state_ns())
    status.paused_in_state = std::chrono::nanoseconds(in->paused_in_state_ns());
  return status;
}

}  // namespace kiln::wire
