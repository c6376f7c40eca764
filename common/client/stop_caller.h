#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "common/core/clock.h"
#include "common/core/error.h"
#include "common/model/link.h"

namespace kiln {

class StopClient;

/// Progress of a STOP.
struct StopReport {
  enum class State : std::uint8_t { Idle, Sent, Latched };
  State state = State::Idle;
  int repetitions = 0;  ///< requests that have left; 0 = none yet, there is no link
  double send_to_latched_s =
      0.0;  ///< robot's latch time minus our send time, through the clock estimate
  double round_trip_s = 0.0;  ///< send -> acknowledgement
  std::uint64_t press = 0;    ///< which press this is about, counted from 1; 0 = none yet
};

/// An operator's half of the STOP lane: one request a press, repeated until the robot answers that
/// press. Knows nothing of lease, hello or heartbeat, so that none of them can delay it.
///
/// Threads: hooks run on the lane's own thread (`stop`), without a lock held. Methods are
/// thread-safe.
class StopCaller {
 public:
  struct Hooks {
    std::function<void(const StopReport&)> on_report;  ///< each repetition, then the latch
    std::function<void(const Error&)> on_bad_message;
    /// Station time of a robot time, nanoseconds; nullopt while the clock offset is unknown.
    std::function<std::optional<std::int64_t>(std::int64_t)> to_station_ns;
  };
  /// @param address  where the robot's STOP lane listens; connecting goes on in the background.
  /// @param clock    outlives the caller.
  [[nodiscard]] static Result<std::unique_ptr<StopCaller>> connect(const std::string& address,
                                                                   std::string client_id,
                                                                   std::string operator_name,
                                                                   Hooks hooks, const Clock& clock);
  ~StopCaller();
  StopCaller(const StopCaller&) = delete;
  StopCaller& operator=(const StopCaller&) = delete;

  void press();
  [[nodiscard]] StopReport report() const;

 private:
  StopCaller(std::string client_id, std::string operator_name, Hooks hooks, const Clock& clock);
  bool onAnswer(std::string_view bytes);
  void onSent();

  const Hooks hooks_;
  const Clock& clock_;
  mutable std::mutex mutex_;  // guards the next two
  StopRequest request_;
  StopReport report_;
  std::unique_ptr<StopClient> client_;  // last: its thread calls all of the above
};

}  // namespace kiln
