#include "common/transport/zmq_socket.h"

#include <array>
#include <cerrno>

#include <zmq.h>

#include "common/core/check.h"

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

constexpr int kLastWords_ms = 50;
constexpr int kReconnect_ms = 50;
constexpr int kReconnectMax_ms = 500;

}  // namespace

ZmqContext::ZmqContext() : handle_(zmq_ctx_new()) {
  KILN_CHECK(handle_ != nullptr, zmq_strerror(zmq_errno()));
  zmq_ctx_set(handle_, ZMQ_BLOCKY, 0);
}

ZmqContext::~ZmqContext() { zmq_ctx_term(handle_); }

ZmqSocket::ZmqSocket(ZmqContext& context, SocketKind kind, const SocketOptions& options)
    : handle_(zmq_socket(context.handle(), typeOf(kind))) {
  KILN_CHECK(handle_ != nullptr, zmq_strerror(zmq_errno()));
  // A closing client's last words are its releases: they get a moment. Everything else is dropped
  // at once.
  set(handle_, ZMQ_LINGER, kind == SocketKind::Dealer ? kLastWords_ms : 0);
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
}

ZmqSocket::~ZmqSocket() { zmq_close(handle_); }

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

std::optional<std::vector<std::string>> ZmqSocket::receive() {
  std::vector<std::string> parts;
  for (;;) {
    zmq_msg_t message;
    zmq_msg_init(&message);
    if (zmq_msg_recv(&message, handle_, ZMQ_DONTWAIT) < 0) {
      zmq_msg_close(&message);
      return std::nullopt;
    }
    parts.emplace_back(static_cast<const char*>(zmq_msg_data(&message)), zmq_msg_size(&message));
    const bool more = zmq_msg_more(&message) != 0;
    zmq_msg_close(&message);
    if (!more) return parts;
  }
}

void waitReadable(std::initializer_list<const ZmqSocket*> sockets, int wake_fd, int timeout_ms) {
  constexpr std::size_t kMost = 4;
  KILN_CHECK(sockets.size() < kMost, sockets.size());
  std::array<zmq_pollitem_t, kMost> items{};
  std::size_t n = 0;
  for (const ZmqSocket* socket : sockets) items[n++] = {socket->handle(), 0, ZMQ_POLLIN, 0};
  items[n++] = {nullptr, wake_fd, ZMQ_POLLIN, 0};
  zmq_poll(items.data(), static_cast<int>(n), timeout_ms);
}

}  // namespace kiln
