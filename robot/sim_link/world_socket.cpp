#include "robot/sim_link/world_socket.h"

#include <cmath>

namespace kiln {
namespace {

constexpr std::chrono::milliseconds kSlice{100};
constexpr int kHelloEvery = 10;  // slices between two hellos
constexpr int kBusyTries = 10;   // slices: a killed daemon's connection closes within one
constexpr int kQueue = 64;       // messages each way
constexpr std::int64_t kMaxReport = 64 << 20;  // bytes; a scan and a picture have two million

Error refused(const v1::device::HelloReply& reply) {
  const ErrorCode code = reply.refusal() == v1::device::REFUSAL_VERSION ? ErrorCode::VersionMismatch
                                                                        : ErrorCode::Refused;
  return {code, "kiln-sim refuses: " + reply.reason()};
}

SocketOptions options() {
  SocketOptions out;
  out.send_hwm = out.receive_hwm = kQueue;
  out.max_message_bytes = kMaxReport;
  out.linger_ms = 500;  // for the bye
  out.watch = true;
  return out;
}

}  // namespace

/// ZeroMQ's own thread must not be what makes a report late.
WorldSocket::WorldSocket(WakeEvent* wake)
    : context_(wake != nullptr), socket_(context_, SocketKind::Dealer, options()), wake_(wake) {}

Result<std::unique_ptr<WorldSocket>> WorldSocket::open(const std::string& endpoint,
                                                       WakeEvent* wake) {
  if (!(endpoint.starts_with("ipc://") && endpoint.size() > 6) &&
      !endpoint.starts_with("tcp://127.0.0.1:") && !endpoint.starts_with("tcp://localhost:")) {
    return makeError(ErrorCode::InvalidInput,
                     "'{}' is no local address; use ipc://PATH or tcp://127.0.0.1:PORT", endpoint);
  }
  std::unique_ptr<WorldSocket> out(new WorldSocket(wake));
  out->endpoint_ = endpoint;
  if (auto connected = out->socket_.connect(endpoint); !connected)
    return makeError(ErrorCode::InvalidInput, "{}", connected.error().message);
  return out;
}

bool WorldSocket::send(const v1::device::ToWorld& message) {
  return socket_.send({message.SerializeAsString()});
}

std::optional<v1::device::ToRobot> WorldSocket::receive(std::chrono::milliseconds wait) {
  auto parts = socket_.receive();
  if (!parts) {
    waitReadable({&socket_}, wake_ ? wake_->fd() : -1, static_cast<int>(wait.count()));
    if (wake_) wake_->clear();
    parts = socket_.receive();
  }
  v1::device::ToRobot message;
  if (!parts || parts->size() != 1 || !message.ParseFromString(parts->front())) return std::nullopt;
  return message;
}

Result<v1::device::HelloReply> WorldSocket::hello(const v1::device::Hello& message,
                                                  double timeout_s) {
  v1::device::ToWorld out;
  *out.mutable_hello() = message;
  const int slices = std::max(1, static_cast<int>(std::lround(timeout_s / 0.1)));
  int since_sent = kHelloEvery, busy = 0;
  std::optional<Error> objection;
  for (int slice = 0; slice < slices; ++slice) {
    if (since_sent++ >= kHelloEvery && send(out)) since_sent = 0;
    const auto answer = receive(kSlice);
    if (lost()) since_sent = kHelloEvery;
    if (!answer || !answer->has_hello()) continue;
    if (answer->hello().accepted()) return answer->hello();
    if (answer->hello().refusal() != v1::device::REFUSAL_BUSY || ++busy > kBusyTries) {
      return tl::make_unexpected(refused(answer->hello()));
    }
    objection = refused(answer->hello());
    (void)receive(kSlice);
    since_sent = kHelloEvery;
  }
  if (objection) return tl::make_unexpected(*objection);
  return makeError(ErrorCode::Unavailable,
                   "kiln-sim does not answer on {} within {:.1f} s; start it first", endpoint_,
                   timeout_s);
}

}  // namespace kiln
