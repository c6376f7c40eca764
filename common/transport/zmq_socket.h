#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/error.h"

namespace kiln {

/// Owner of one ZeroMQ context; sockets must be gone before it. The library's header stays in the
/// .cpp.
class ZmqContext {
 public:
  /// @param realtime  its own thread runs before all ordinary ones, where that is allowed.
  explicit ZmqContext(bool realtime = false);
  ~ZmqContext();
  ZmqContext(const ZmqContext&) = delete;
  ZmqContext& operator=(const ZmqContext&) = delete;
  [[nodiscard]] void* handle() const { return handle_; }

 private:
  void* handle_;
};

enum class SocketKind { Dealer, Sub };

struct SocketOptions {
  int send_hwm = 64;  ///< messages a peer
  int receive_hwm = 64;
  std::int64_t max_message_bytes = 64 << 10;  ///< a peer that sends more is disconnected
  std::string routing_id{};                   ///< Dealer only
  int linger_ms = 0;                          ///< last words get so long
  bool watch = false;                         ///< for lost()
};

/// A non-blocking connecting socket (the listening ones are ZmtpServer's); a Dealer queues for
/// living connections only. Confined to one thread once in use.
class ZmqSocket {
 public:
  ZmqSocket(ZmqContext& context, SocketKind kind, const SocketOptions& options);
  ~ZmqSocket();
  ZmqSocket(const ZmqSocket&) = delete;
  ZmqSocket& operator=(const ZmqSocket&) = delete;

  /// Error Unavailable: not possible, in one sentence.
  [[nodiscard]] Result<void> connect(const std::string& address);
  void subscribe(std::string_view prefix);
  /// @return false when it cannot be queued now: peer gone or too slow. Nothing was sent then.
  [[nodiscard]] bool send(std::initializer_list<std::string_view> parts);
  /// A whole multipart message, or nullopt when none is waiting.
  [[nodiscard]] std::optional<std::vector<std::string>> receive();
  /// Whether the connection closed since the last call. @pre SocketOptions::watch.
  [[nodiscard]] bool lost();
  [[nodiscard]] void* handle() const { return handle_; }

 private:
  friend void waitReadable(std::initializer_list<const ZmqSocket*> sockets, int wake_fd,
                           int timeout_ms);
  void* handle_;
  void* monitor_ = nullptr;
};

/// Waits until one of the sockets or `wake_fd` is readable, or a watched connection closes, at most
/// `timeout_ms`. @param wake_fd  < 0: none.
void waitReadable(std::initializer_list<const ZmqSocket*> sockets, int wake_fd, int timeout_ms);

}  // namespace kiln
