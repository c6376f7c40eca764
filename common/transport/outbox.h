#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "common/core/mutex.h"
#include "common/core/stamp.h"
#include "common/transport/frame.h"
#include "common/transport/monotonic.h"

namespace kiln {

/// What waits in front of the PUB sockets: one bounded queue a topic (the oldest goes, counted),
/// rate caps, and the newest of each latched topic. Values wait un-encoded, so that what is dropped
/// or wanted by nobody costs nothing. push() from any thread; the rest from the link thread.
class Outbox {
 public:
  using Encode = std::function<std::string()>;
  struct Message {
    Topic topic;
    FrameHeader header;
    std::string payload;
  };

  void push(Topic topic, Encode encode, Stamp now);
  /// Next message that may go now, status lane first; encodes it. Topics that nobody subscribes to
  /// are emptied without encoding, unless latched.
  [[nodiscard]] std::optional<Message> take(Monotonic::time_point now);
  /// Seconds until take() may have something that a rate cap holds back now; nullopt: nothing
  /// waits.
  [[nodiscard]] std::optional<double> waits(Monotonic::time_point now) const;
  /// The newest of a latched topic, again, as one more message of it; nullopt when there was none
  /// yet.
  [[nodiscard]] std::optional<Message> again(Topic topic, Stamp now);
  /// The newest of a latched topic for one late subscriber: of no new number, so that the others
  /// miss none.
  [[nodiscard]] std::optional<Message> newest(Topic topic, Stamp now) const;

  void setSubscribed(Topic topic, bool subscribed);
  [[nodiscard]] bool subscribed(Topic topic) const;
  [[nodiscard]] std::uint64_t dropped(Topic topic) const;

 private:
  struct Waiting {
    Encode encode;
    Stamp stamp;
  };
  struct Row {
    std::deque<Waiting> waiting;
    bool subscribed = false;
    std::uint64_t dropped = 0;
    std::uint64_t seq = 0;
    std::optional<Monotonic::time_point> last_sent;
    std::string latched;
  };
  [[nodiscard]] static double holdBack(const TopicInfo& info, const Row& row,
                                       Monotonic::time_point now);

  mutable Mutex mutex_;
  std::array<Row, kTopicCount> rows_;
};

}  // namespace kiln
