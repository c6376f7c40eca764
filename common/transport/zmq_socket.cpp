#include "common/transport/zmq_socket.h"

#include <array>
#include <cerrno>

#include <fmt/format.h>
#include <sched.h>
#include <zmq.h>

#include "common/core/check.h"
#include "common/core/scheduling.h"

namespace kiln {
namespace {

int typeOf(SocketKind kind) {
  switch (kind) {
    case SocketKind::Dealer:
      return ZMQ_DEALER;
    case SocketKind::Sub:
      return ZMQ_SUB;
  }
  return ZMQ_PAIR;
}

template <class T>
void set(void* socket, int option, T value) {
  const int rc = zmq_setsockopt(socket, option, &value, sizeof value);
  KILN_CHECK(rc == 0, option, zmq_strerror(zmq_errno()));
}

constexpr int kReconnect_ms = 50;
constexpr int kReconnectMax_ms = 500;

/// A whole message, or nullopt when none is waiting.
std::optional<std::vector<std::string>> receiveFrom(void* socket) {
  std::vector<std::string> parts;
  for (;;) {
    zmq_msg_t message;
    zmq_msg_init(&message);
    if (zmq_msg_recv(&message, socket, ZMQ_DONTWAIT) < 0) {
      zmq_msg_close(&message);
      return std::nullopt;
    }
    parts.emplace_back(static_cast<const char*>(zmq_msg_data(&message)), zmq_msg_size(&message));
    const bool more = zmq_msg_more(&message) != 0;
    zmq_msg_close(&message);
    if (!more) return parts;
  }
}

/// A socket that says when a connection of `socket` closed.
void* watch(void* context, void* socket) {
  const std::string address = fmt::format("inproc://kiln.watch.{}", socket);
  int rc = zmq_socket_monitor(socket, address.c_str(), ZMQ_EVENT_DISCONNECTED);
  KILN_CHECK(rc == 0, zmq_strerror(zmq_errno()));
  void* monitor = zmq_socket(context, ZMQ_PAIR);
  KILN_CHECK(monitor != nullptr, zmq_strerror(zmq_errno()));
  set(monitor, ZMQ_LINGER, 0);
  rc = zmq_connect(monitor, address.c_str());
  KILN_CHECK(rc == 0, zmq_strerror(zmq_errno()));
  return monitor;
}

}  // namespace

ZmqContext::ZmqContext(bool realtime) : handle_(zmq_ctx_new()) {
  KILN_CHECK(handle_ != nullptr, zmq_strerror(zmq_errno()));
  zmq_ctx_set(handle_, ZMQ_BLOCKY, 0);
  if (const auto priority = realtime ? realtimePriority() : std::nullopt) {
    zmq_ctx_set(handle_, ZMQ_THREAD_SCHED_POLICY, SCHED_RR);
    zmq_ctx_set(handle_, ZMQ_THREAD_PRIORITY, *priority);
  }
}

ZmqContext::~ZmqContext() { zmq_ctx_term(handle_); }

ZmqSocket::ZmqSocket(ZmqContext& context, SocketKind kind, const SocketOptions& options)
    : handle_(zmq_socket(context.handle(), typeOf(kind))) {
  KILN_CHECK(handle_ != nullptr, zmq_strerror(zmq_errno()));
  set(handle_, ZMQ_LINGER, options.linger_ms);
  set(handle_, ZMQ_SNDHWM, options.send_hwm);
  set(handle_, ZMQ_RCVHWM, options.receive_hwm);
  set(handle_, ZMQ_MAXMSGSIZE, options.max_message_bytes);
  set(handle_, ZMQ_RECONNECT_IVL, kReconnect_ms);
  set(handle_, ZMQ_RECONNECT_IVL_MAX, kReconnectMax_ms);
  if (kind == SocketKind::Dealer) {
    set(handle_, ZMQ_IMMEDIATE, 1);
    if (!options.routing_id.empty()) {
      const int rc = zmq_setsockopt(handle_, ZMQ_ROUTING_ID, options.routing_id.data(),
                                    options.routing_id.size());
      KILN_CHECK(rc == 0, zmq_strerror(zmq_errno()));
    }
  }
  if (options.watch) monitor_ = watch(context.handle(), handle_);
}

ZmqSocket::~ZmqSocket() {
  if (monitor_) zmq_close(monitor_);
  zmq_close(handle_);
}

bool ZmqSocket::lost() {
  KILN_CHECK(monitor_ != nullptr);
  bool closed = false;
  // An event is two parts; which one it is was chosen by the monitor.
  while (receiveFrom(monitor_)) closed = true;
  return closed;
}

Result<void> ZmqSocket::connect(const std::string& address) {
  if (zmq_connect(handle_, address.c_str()) == 0) return {};
  return makeError(ErrorCode::Unavailable, "{} cannot be connected to: {}", address,
                   zmq_strerror(zmq_errno()));
}

void ZmqSocket::subscribe(std::string_view prefix) {
  const int rc = zmq_setsockopt(handle_, ZMQ_SUBSCRIBE, prefix.data(), prefix.size());
  KILN_CHECK(rc == 0, zmq_strerror(zmq_errno()));
}

bool ZmqSocket::send(std::initializer_list<std::string_view> parts) {
  std::size_t left = parts.size();
  for (const std::string_view part : parts) {
    const int flags = ZMQ_DONTWAIT | (--left > 0 ? ZMQ_SNDMORE : 0);
    if (zmq_send(handle_, part.data(), part.size(), flags) < 0) return false;
  }
  return true;
}

std::optional<std::vector<std::string>> ZmqSocket::receive() { return receiveFrom(handle_); }

void waitReadable(std::initializer_list<const ZmqSocket*> sockets, int wake_fd, int timeout_ms) {
  constexpr std::size_t kMost = 8;
  KILN_CHECK(2 * sockets.size() < kMost, sockets.size());
  std::array<zmq_pollitem_t, kMost> items{};
  std::size_t n = 0;
  for (const ZmqSocket* socket : sockets) {
    items[n++] = {socket->handle_, 0, ZMQ_POLLIN, 0};
    if (socket->monitor_) items[n++] = {socket->monitor_, 0, ZMQ_POLLIN, 0};
  }
  if (wake_fd >= 0) items[n++] = {nullptr, wake_fd, ZMQ_POLLIN, 0};
  zmq_poll(items.data(), static_cast<int>(n), timeout_ms);
}

}  // namespace kiln
