#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/clock.h"
#include "common/core/error.h"
#include "common/transport/endpoint.h"
#include "common/transport/outbox.h"
#include "common/transport/zmtp_server.h"

namespace kiln {

/// The robot's sockets for commands, status and streams and the `link` thread that owns them. Bytes
/// only; what they mean is the caller's. A connection is its peer's identity: whatever it calls
/// itself, nobody else's messages come under its number. Handlers run on the link thread; the other
/// methods are thread-safe.
class RobotEnd {
 public:
  struct Handlers {
    std::function<void(PeerId peer, std::string_view message)> on_message;
    std::function<void(PeerId peer)> on_closed;
    std::function<void()> on_tick;  ///< at least 10 times a second
  };
  /// Error Unavailable when one of the addresses is in use.
  [[nodiscard]] static Result<std::unique_ptr<RobotEnd>> bind(const LinkAddresses& addresses,
                                                              const Clock& clock);
  ~RobotEnd();

  void start(Handlers handlers);
  /// Queued (1024, the newest is dropped) and sent by the link thread.
  void send(PeerId peer, std::string message);
  /// On the link thread: this peer is known, no newcomer displaces it; or it is no more.
  void keep(PeerId peer, bool known);
  /// On the link thread: how the log names it.
  [[nodiscard]] std::string nameOf(PeerId peer) const;
  void publish(Topic topic, Outbox::Encode encode);
  [[nodiscard]] bool subscribed(Topic topic) const;
  [[nodiscard]] std::uint64_t dropped(Topic topic) const;
  /// Messages to peers that were gone or too slow.
  [[nodiscard]] std::uint64_t droppedSends() const;

 private:
  struct Impl;
  explicit RobotEnd(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
