#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/core/error.h"

namespace kiln {

/// Complete bytes of one message on the wire, shared by all peers that it goes to.
using ZmtpMessage = std::shared_ptr<const std::string>;

/// One message of several parts, framed (ZMTP 3.0, rfc.zeromq.org/spec/23).
[[nodiscard]] ZmtpMessage frameMessage(std::initializer_list<std::string_view> parts);

/// What a listening socket is to its peers.
enum class ZmtpKind { Router, Publisher };

/// The listening side of one ZMTP 3.0 connection with the NULL mechanism: bytes in, messages out,
/// no socket. A peer may send messages of one part only, at most `max_message_bytes` long; a longer
/// one is refused by its header. Holds at most one message and what was fed beyond it.
/// Thread-compatible.
class ZmtpPeer {
 public:
  ZmtpPeer(ZmtpKind kind, std::size_t max_message_bytes);

  void feed(std::string_view bytes) { in_.append(bytes); }
  /// The next message, valid until the next call; nullopt: more bytes are needed.
  /// Error: the peer breaks the protocol or a limit, and the connection is to be closed.
  [[nodiscard]] Result<std::optional<std::string_view>> next();
  /// What is to be sent back for the handshake and pings; empties it.
  [[nodiscard]] std::string takeOutput();
  [[nodiscard]] bool ready() const { return state_ == State::Open; }
  [[nodiscard]] std::size_t buffered() const { return in_.size() - at_; }

 private:
  enum class State { Greeting, Handshake, Open };
  struct Frame {
    bool more = false;
    bool command = false;
    std::string_view body;
  };
  [[nodiscard]] Result<bool> readGreeting();
  [[nodiscard]] Result<std::optional<Frame>> readFrame();
  [[nodiscard]] Result<void> onCommand(std::string_view body);
  [[nodiscard]] Result<void> onReady(std::string_view properties);

  ZmtpKind kind_;
  std::size_t max_message_bytes_;
  State state_ = State::Greeting;
  std::string in_, out_;
  std::size_t at_ = 0;  ///< of in_, read so far
};

}  // namespace kiln
