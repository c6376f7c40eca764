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

namespace kiln {

/// The robot's sockets for commands (ROUTER), status and streams (PUB) and the `link` thread that
/// owns them. Bytes only; what they mean is the caller's. Handlers run on the link thread; the
/// other methods are thread-safe.
class RobotEnd {
 public:
  struct Handlers {
    std::function<void(const std::string& peer, std::string_view message)> on_message;
    std::function<void()> on_tick;  ///< at least 10 times a second
  };
  /// Error Unavailable when one of the addresses is in use.
  [[nodiscard]] static Result<std::unique_ptr<RobotEnd>> bind(const LinkAddresses& addresses,
                                                              const Clock& clock);
  ~RobotEnd();

  void start(Handlers handlers);
  /// Queued (256, the newest is dropped) and sent by the link thread.
  void send(const std::string& peer, std::string message);
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
