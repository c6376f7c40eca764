#include "robot/sim_link/world_socket.h"

#include <cmath>

#include <sched.h>
#include <unistd.h>
#include <zmq.hpp>

#include "common/core/scheduling.h"

namespace kiln {
namespace {

constexpr std::chrono::milliseconds kSlice{100};
constexpr int kHelloEvery = 10;  // slices between two hellos
constexpr int kBusyTries = 10;   // slices: a killed daemon's connection closes within one
constexpr int kQueue = 64;       // messages each way
constexpr std::int64_t kMaxReport = 64 << 20;  // bytes; a scan and a picture have two million
constexpr const char* kMonitor = "inproc://kiln.sim_link.monitor";

Error refused(const v1::device::HelloReply& reply) {
  const ErrorCode code = reply.refusal() == v1::device::REFUSAL_VERSION ? ErrorCode::VersionMismatch
                                                                        : ErrorCode::Refused;
  return {code, "kiln-sim refuses: " + reply.reason()};
}

/// ZeroMQ's own thread must not be what makes a report late.
zmq::context_t makeContext(bool realtime) {
  zmq::context_t context{1};
  if (const auto priority = realtime ? realtimePriority() : std::nullopt) {
    context.set(zmq::ctxopt::thread_sched_policy, SCHED_RR);
    context.set(zmq::ctxopt::thread_priority, *priority);
  }
  return context;
}

}  // namespace

struct WorldSocket::Sockets {
  explicit Sockets(bool realtime) : context(makeContext(realtime)) {}
  zmq::context_t context;
  zmq::socket_t data{context, zmq::socket_type::dealer};
  zmq::socket_t monitor{context, zmq::socket_type::pair};
};

WorldSocket::WorldSocket(int wake_fd)
    : sockets_(std::make_unique<Sockets>(wake_fd >= 0)), wake_fd_(wake_fd) {}

WorldSocket::~WorldSocket() = default;

Result<std::unique_ptr<WorldSocket>> WorldSocket::open(const std::string& endpoint, int wake_fd) {
  if (!(endpoint.starts_with("ipc://") && endpoint.size() > 6) &&
      !endpoint.starts_with("tcp://127.0.0.1:") && !endpoint.starts_with("tcp://localhost:")) {
    return makeError(ErrorCode::InvalidInput,
                     "'{}' is no local address; use ipc://PATH or tcp://127.0.0.1:PORT", endpoint);
  }
  std::unique_ptr<WorldSocket> out(new WorldSocket(wake_fd));
  out->endpoint_ = endpoint;
  try {
    out->sockets_->data.set(zmq::sockopt::linger, 500);  // ms, for the bye
    out->sockets_->data.set(zmq::sockopt::immediate, true);
    out->sockets_->data.set(zmq::sockopt::sndhwm, kQueue);
    out->sockets_->data.set(zmq::sockopt::rcvhwm, kQueue);
    out->sockets_->data.set(zmq::sockopt::maxmsgsize, kMaxReport);
    ::zmq_socket_monitor(out->sockets_->data.handle(), kMonitor, ZMQ_EVENT_DISCONNECTED);
    out->sockets_->monitor.set(zmq::sockopt::linger, 0);
    out->sockets_->monitor.connect(kMonitor);
    out->sockets_->data.connect(endpoint);
  } catch (const zmq::error_t& e) {
    return makeError(ErrorCode::InvalidInput, "cannot use address {}: {}", endpoint, e.what());
  }
  return out;
}

bool WorldSocket::send(const v1::device::ToWorld& message) {
  zmq::message_t body(message.ByteSizeLong());
  message.SerializeWithCachedSizesToArray(body.data<std::uint8_t>());
  try {
    return sockets_->data.send(body, zmq::send_flags::dontwait).has_value();
  } catch (const zmq::error_t&) {
    return false;  // interrupted or closing: the caller tries again or reports the loss
  }
}

std::optional<v1::device::ToRobot> WorldSocket::receive(std::chrono::milliseconds wait) {
  zmq::message_t body;
  try {
    if (!sockets_->data.recv(body, zmq::recv_flags::dontwait)) {
      zmq::pollitem_t items[] = {{sockets_->data.handle(), 0, ZMQ_POLLIN, 0},
                                 {sockets_->monitor.handle(), 0, ZMQ_POLLIN, 0},
                                 {nullptr, wake_fd_, ZMQ_POLLIN, 0}};
      zmq::poll(items, wake_fd_ >= 0 ? 3 : 2, wait);
      if (wake_fd_ >= 0 && (items[2].revents & ZMQ_POLLIN) != 0) {
        std::uint64_t count = 0;
        (void)!::read(wake_fd_, &count, sizeof(count));
      }
      if (!sockets_->data.recv(body, zmq::recv_flags::dontwait)) return std::nullopt;
    }
  } catch (const zmq::error_t&) {
    return std::nullopt;  // a signal came in between
  }
  v1::device::ToRobot message;
  if (!message.ParseFromArray(body.data(), static_cast<int>(body.size()))) return std::nullopt;
  return message;
}

bool WorldSocket::lost() {
  zmq::message_t event, address;
  bool closed = false;
  while (sockets_->monitor.recv(event, zmq::recv_flags::dontwait)) {
    (void)sockets_->monitor.recv(address, zmq::recv_flags::none);
    closed = true;
  }
  return closed;
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
