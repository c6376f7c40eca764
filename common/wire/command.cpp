#include "common/wire/command.h"

#include "common/wire/command_body.h"
#include "common/wire/proto_message.h"

namespace kiln::wire {
namespace {

constexpr std::size_t kMaxCommandBytes = 64u << 10;
/// A STOP counts whatever its sender calls himself.
constexpr std::size_t kMaxStopBytes = 256u << 10;

/// Whole nanoseconds of any clock that ever ran: differences of two cannot overflow.
constexpr std::int64_t kMaxStamp_ns = std::int64_t{1} << 61;

Result<void> checkStamp(std::int64_t ns) {
  if (ns >= -kMaxStamp_ns && ns <= kMaxStamp_ns) return {};
  return makeError(ErrorCode::InvalidInput, "a stamp of {} ns is no time of any clock; dropped",
                   ns);
}

Result<void> checkDuration(double seconds) {
  constexpr double kMost_s = 1e9;
  if (seconds >= 0.0 && seconds <= kMost_s) return {};  // NaN is neither
  return makeError(ErrorCode::InvalidInput, "a duration of {} s cannot be; dropped", seconds);
}

Result<void> firstError(std::initializer_list<Result<void>> checks) {
  for (const Result<void>& check : checks) {
    if (!check) return check;
  }
  return {};
}

void toProto(const Hello& hello, v1::Hello& out) {
  out.set_protocol(hello.protocol);
  out.set_version(hello.version);
  out.set_client_id(hello.client_id);
  out.set_operator_name(validUtf8(hello.operator_name));
  out.set_expected_mission_uuid(hello.expected_mission_uuid);
  out.set_role(static_cast<std::uint32_t>(hello.role));
  out.set_key(hello.key);
}

Result<Hello> fromProto(const v1::Hello& in) {
  // No enum check before the protocol number has been judged: another version may know other roles.
  const auto role = toEnum(in.role(), ClientRole::Supervisor, "role");
  if (!role && in.protocol() == kProtocolVersion) return tl::make_unexpected(role.error());
  Hello hello;
  hello.protocol = in.protocol();
  hello.version = printableName(in.version());
  hello.client_id = printableName(in.client_id());
  hello.operator_name = printableName(in.operator_name());
  hello.role = role.value_or(ClientRole::Viewer);
  hello.expected_mission_uuid = printableName(in.expected_mission_uuid());
  hello.key = in.key();
  return hello;
}

void toProto(const Heartbeat& heartbeat, v1::Heartbeat& out) {
  out.set_seq(heartbeat.seq);
  out.set_station_send_ns(heartbeat.station_send_ns);
  out.set_robot_receive_ns(heartbeat.robot_receive_ns);
  out.set_robot_send_ns(heartbeat.robot_send_ns);
  out.set_rx_age_s(heartbeat.rx_age_s);
  out.set_rtt_s(heartbeat.rtt_s);
  out.set_robot_estimate_ns(heartbeat.robot_estimate_ns);
}

Result<Heartbeat> fromProto(const v1::Heartbeat& in) {
  if (auto ok = firstError({checkStamp(in.station_send_ns()), checkStamp(in.robot_receive_ns()),
                            checkStamp(in.robot_send_ns()), checkStamp(in.robot_estimate_ns()),
                            checkDuration(in.rx_age_s()), checkDuration(in.rtt_s())});
      !ok) {
    return tl::make_unexpected(ok.error());
  }
  return Heartbeat{in.seq(),      in.station_send_ns(), in.robot_receive_ns(), in.robot_send_ns(),
                   in.rx_age_s(), in.rtt_s(),           in.robot_estimate_ns()};
}

void toProto(const Command& command, v1::Command& out) {
  out.set_client_id(command.client_id);
  out.set_operator_name(validUtf8(command.operator_name));
  out.set_nonce(command.nonce);
  out.set_lease_epoch(command.lease_epoch);
  out.set_issued_robot_ns(toNanoseconds(command.issued));
  out.set_press(command.press);
  bodyToProto(command.body, out);
}

Result<Command> fromProto(const v1::Command& in) {
  if (auto ok = checkStamp(in.issued_robot_ns()); !ok) return tl::make_unexpected(ok.error());
  auto body = bodyFromProto(in);
  if (!body) return tl::make_unexpected(body.error());
  Command command;
  command.client_id = printableName(in.client_id());
  command.operator_name = printableName(in.operator_name());
  command.nonce = in.nonce();
  command.lease_epoch = in.lease_epoch();
  command.issued = stampFromNanoseconds(in.issued_robot_ns());
  command.press = in.press();
  command.body = std::move(*body);
  return command;
}

void toProto(const HelloReply& reply, v1::HelloReply& out) {
  out.set_accepted(reply.accepted);
  out.set_reason(validUtf8(reply.reason));
  out.set_robot_name(validUtf8(reply.robot_name));
  out.set_version(reply.version);
  out.set_protocol(reply.protocol);
  out.set_mission_uuid(reply.mission_uuid);
  out.set_environment(static_cast<std::uint32_t>(reply.environment));
}

Result<HelloReply> fromProto(const v1::HelloReply& in) {
  const auto environment = toEnum(in.environment(), Environment::Replay, "environment");
  if (!environment && in.protocol() == kProtocolVersion)
    return tl::make_unexpected(environment.error());
  return HelloReply{in.accepted(),
                    in.reason(),
                    in.robot_name(),
                    in.version(),
                    in.protocol(),
                    in.mission_uuid(),
                    environment.value_or(Environment::Live)};
}

void toProto(const CommandAck& ack, v1::CommandAck& out) {
  out.set_client_id(ack.client_id);
  out.set_nonce(ack.nonce);
  out.set_command(ack.command);
  out.set_outcome(static_cast<std::uint32_t>(ack.outcome));
  out.set_code(ack.code);
  out.set_reason(validUtf8(ack.reason));
  out.set_lease_holder(validUtf8(ack.lease_holder));
  out.set_lease_epoch(ack.lease_epoch);
}

Result<CommandAck> fromProto(const v1::CommandAck& in) {
  const auto outcome = toEnum(in.outcome(), AckOutcome::Cancelled, "command outcome");
  if (!outcome) return tl::make_unexpected(outcome.error());
  CommandAck ack;
  ack.client_id = in.client_id();
  ack.nonce = in.nonce();
  ack.command = in.command();
  ack.outcome = *outcome;
  ack.code = in.code();
  ack.reason = in.reason();
  ack.lease_holder = in.lease_holder();
  ack.lease_epoch = in.lease_epoch();
  return ack;
}

struct ToRobotWriter {
  v1::ToRobot& out;
  void operator()(const Hello& m) const { toProto(m, *out.mutable_hello()); }
  void operator()(const Heartbeat& m) const { toProto(m, *out.mutable_heartbeat()); }
  void operator()(const Command& m) const { toProto(m, *out.mutable_command()); }
};
struct ToStationWriter {
  v1::ToStation& out;
  void operator()(const HelloReply& m) const { toProto(m, *out.mutable_hello()); }
  void operator()(const Heartbeat& m) const { toProto(m, *out.mutable_heartbeat()); }
  void operator()(const CommandAck& m) const { toProto(m, *out.mutable_ack()); }
};

/// Lifts Result<Alternative> into Result<Variant>.
template <class Variant, class T>
Result<Variant> widen(Result<T> value) {
  if (!value) return tl::make_unexpected(value.error());
  return Variant{std::move(*value)};
}

}  // namespace

std::string encode(const ToRobot& message) {
  v1::ToRobot out;
  std::visit(ToRobotWriter{out}, message);
  return serialise(out);
}

std::string encode(const ToStation& message) {
  v1::ToStation out;
  std::visit(ToStationWriter{out}, message);
  return serialise(out);
}

Result<ToRobot> decodeToRobot(std::string_view bytes) {
  const auto in = parse<v1::ToRobot>(bytes, kMaxCommandBytes, "message to the robot");
  if (!in) return tl::make_unexpected(in.error());
  switch (in->message_case()) {
    case v1::ToRobot::kHello:
      return widen<ToRobot>(fromProto(in->hello()));
    case v1::ToRobot::kHeartbeat:
      return widen<ToRobot>(fromProto(in->heartbeat()));
    case v1::ToRobot::kCommand:
      return widen<ToRobot>(fromProto(in->command()));
    case v1::ToRobot::MESSAGE_NOT_SET:
      break;
  }
  return makeError(ErrorCode::InvalidInput, "message to the robot is of an unknown kind; dropped");
}

Result<ToStation> decodeToStation(std::string_view bytes) {
  const auto in = parse<v1::ToStation>(bytes, kMaxCommandBytes, "message to the station");
  if (!in) return tl::make_unexpected(in.error());
  switch (in->message_case()) {
    case v1::ToStation::kHello:
      return widen<ToStation>(fromProto(in->hello()));
    case v1::ToStation::kHeartbeat:
      return widen<ToStation>(fromProto(in->heartbeat()));
    case v1::ToStation::kAck:
      return widen<ToStation>(fromProto(in->ack()));
    case v1::ToStation::MESSAGE_NOT_SET:
      break;
  }
  return makeError(ErrorCode::InvalidInput,
                   "message to the station is of an unknown kind; dropped");
}

std::string encode(const StopRequest& request) {
  v1::StopRequest out;
  out.set_client_id(request.client_id);
  out.set_operator_name(validUtf8(request.operator_name));
  out.set_nonce(request.nonce);
  out.set_sent_station_ns(request.sent_station_ns);
  return serialise(out);
}

Result<StopRequest> decodeStopRequest(std::string_view bytes) {
  const auto in = parse<v1::StopRequest>(bytes, kMaxStopBytes, "stop request");
  if (!in) return tl::make_unexpected(in.error());
  return StopRequest{printableName(in->client_id()), printableName(in->operator_name()),
                     in->nonce(), in->sent_station_ns()};
}

std::string encode(const StopAck& ack) {
  v1::StopAck out;
  out.set_nonce(ack.nonce);
  out.set_sent_station_ns(ack.sent_station_ns);
  out.set_latched_robot_ns(ack.latched_robot_ns);
  out.set_latched(ack.latched);
  return serialise(out);
}

Result<StopAck> decodeStopAck(std::string_view bytes) {
  const auto in = parse<v1::StopAck>(bytes, kMaxCommandBytes, "stop acknowledgement");
  if (!in) return tl::make_unexpected(in.error());
  if (auto ok = firstError({checkStamp(in->sent_station_ns()), checkStamp(in->latched_robot_ns())});
      !ok) {
    return tl::make_unexpected(ok.error());
  }
  return StopAck{in->nonce(), in->sent_station_ns(), in->latched_robot_ns(), in->latched()};
}

}  // namespace kiln::wire
