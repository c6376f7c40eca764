#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/clock.h"
#include "common/core/error.h"
#include "common/transport/endpoint.h"
#include "common/transport/frame.h"

namespace kiln {

/// Faults put into a link on purpose, for training and tests. Losses are drawn from `seed`.
struct LinkFaults {
  double up_loss = 0.0;    ///< share of messages to the robot thrown away, 0..1
  double down_loss = 0.0;  ///< share of messages from the robot
  double up_delay_s = 0.0;
  std::uint64_t seed = 1;
};

/// A station's sockets for commands (DEALER) and subscriptions (SUB) and the `link` thread that
/// owns them. Bytes only. Handlers run on the link thread; send() is thread-safe.
class StationEnd {
 public:
  struct Handlers {
    std::function<void(std::string_view message)> on_message;
    /// @param lost  messages of this topic lost on the way since the previous one.
    std::function<void(Topic topic, const FrameHeader& header, std::string_view payload,
                       std::uint64_t lost)>
        on_published;
    std::function<void(std::string reason)> on_bad;
    std::function<void()> on_tick;  ///< every `tick_s` or a little later
  };
  struct Options {
    std::string client_id;      ///< routing id; unique
    std::vector<Topic> topics;  ///< to subscribe to
    double tick_s = 0.02;
    LinkFaults faults;
  };
  [[nodiscard]] static Result<std::unique_ptr<StationEnd>> connect(const LinkAddresses& addresses,
                                                                   Options options);
  ~StationEnd();

  void start(Handlers handlers);
  /// @return false when 64 are waiting already: nothing is queued then.
  bool send(std::string message);
  /// Wakes the link thread for an extra tick.
  void wake();
  /// Messages that could not go: no connection, or too many waiting.
  [[nodiscard]] std::uint64_t droppedSends() const;
  /// Messages that faults threw away.
  [[nodiscard]] std::uint64_t faulted() const;

 private:
  struct Impl;
  explicit StationEnd(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
