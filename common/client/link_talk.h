#pragma once

#include <array>
#include <optional>
#include <string>

#include "common/client/link_watch.h"
#include "common/transport/clock_sync.h"
#include "common/transport/topics.h"

namespace kiln {

/// What keeps a link alive, without sockets: hello until the robot accepts us, then heartbeats;
/// from them the clock offset, how well each side hears the other, and what was lost.
/// Thread-compatible: the session's mutex guards it.
class LinkTalk {
 public:
  /// @param hello  said until it is accepted, and again after a refusal.
  LinkTalk(Hello hello, double degraded_after_s, double lost_after_s)
      : hello_(std::move(hello)), watch_(degraded_after_s, lost_after_s) {}

  void heard(std::size_t bytes, Monotonic::time_point now);
  /// A refusal: a robot that restarted does not know us, its clock may be another one.
  void onHelloReply(const HelloReply& reply);
  void onHeartbeat(const Heartbeat& heartbeat, std::int64_t received_ns, Monotonic::time_point now);
  void onFrame(Topic topic, std::uint64_t lost, std::uint64_t dropped_by_robot);

  /// What is due to be said, if anything. Each answer is taken for sent.
  [[nodiscard]] std::optional<ToRobot> due(Monotonic::time_point now, std::int64_t clock_ns);
  /// The robot's time of a command issued now; nullopt while none may be sent.
  [[nodiscard]] std::optional<std::int64_t> commandTime(Monotonic::time_point now,
                                                        std::int64_t clock_ns) const;
  [[nodiscard]] LinkReport report(Monotonic::time_point now, std::uint64_t dropped_sends) const;
  [[nodiscard]] const ClockSync& clock() const { return sync_; }

 private:
  Hello hello_;
  LinkWatch watch_;
  ClockSync sync_;
  std::uint64_t heartbeats_ = 0;
  int quick_heartbeats_ = 0;
  std::optional<Monotonic::time_point> hello_sent_, heartbeat_sent_;
  std::uint64_t bytes_received_ = 0;
  std::array<std::uint64_t, kTopicCount> lost_{}, robot_dropped_{};
};

}  // namespace kiln
