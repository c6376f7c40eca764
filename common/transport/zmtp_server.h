#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/transport/monotonic.h"
#include "common/transport/zmtp_peer.h"

namespace kiln {

/// One connection; never used again for another.
using PeerId = std::uint64_t;

/// A listening ZeroMQ socket whose memory, descriptors and work are bounded by peer and in all,
/// whatever its peers do (decision 18). A peer that breaks the protocol or a limit is closed and
/// named in the log, once a second; one that sends more than its share is read more slowly. Never
/// blocks. Confined to one thread once in use.
class ZmtpServer {
 public:
  struct Limits {
    std::size_t max_peers = 64;  ///< fewer where RLIMIT_NOFILE is small
    std::size_t max_message_bytes = 64 << 10;
    std::size_t max_queued = 64;  ///< messages to one peer that does not read
    std::size_t max_queued_bytes = 1 << 20;
    double messages_per_s = 250.0;  ///< what is read of one peer, in the long run
    double bytes_per_s = 256 << 10;
    double kept_messages_per_s = 250.0;  ///< of one that the caller keeps
    double kept_bytes_per_s = 256 << 10;
  };
  struct Handlers {
    std::function<void(PeerId from, std::string_view message)> on_message;
    std::function<void(PeerId peer)> on_closed;
    /// A peer whose handshake was fine breaks the protocol; it is closed then.
    std::function<void(PeerId peer)> on_violation;
  };
  /// @param address  tcp://HOST:PORT or ipc:///PATH, as of parseEndpoint().
  /// Error Unavailable: in use, or not possible, in one sentence.
  [[nodiscard]] static Result<std::unique_ptr<ZmtpServer>> bind(const std::string& address,
                                                                ZmtpKind kind, Limits limits);
  ~ZmtpServer();

  void setHandlers(Handlers handlers);
  /// Readable when serve() has something to do.
  [[nodiscard]] int fd() const;
  /// Takes in what came, sends what waits: a bounded piece of work.
  void serve();
  /// At most so long may the caller wait for fd(): a peer that is read slowly has its turn then.
  [[nodiscard]] double wait_s() const;

  /// @return false when the peer is gone or reads too slowly. Nothing was sent then.
  [[nodiscard]] bool send(PeerId to, const ZmtpMessage& message);
  /// This peer is known to the caller: it is not closed to make room for a newcomer. Or it is no
  /// longer.
  void keep(PeerId peer, bool known = true);
  /// How the log names it: process of an ipc peer, address of a tcp one.
  [[nodiscard]] std::string nameOf(PeerId peer) const;

 private:
  struct Impl;
  explicit ZmtpServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
