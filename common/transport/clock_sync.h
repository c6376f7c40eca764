#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace kiln {

/// Offset and drift between the station's clock and the robot's, from heartbeat exchanges. Every
/// exchange bounds the offset within half its round trip; those with the shortest round trips are
/// believed (min-RTT filter), a line through them gives the drift. An exchange whose bounds exclude
/// the estimate means that a clock stepped (robot restarted): the filter starts anew.
/// Thread-compatible.
class ClockSync {
 public:
  struct Estimate {
    double offset_s = 0.0;  ///< robot minus station, at the newest exchange
    double drift_ppm = 0.0;
    double uncertainty_s = 0.0;  ///< half-width
    double rtt_s = 0.0;          ///< of the newest exchange
    double rtt_p95_s = 0.0;      ///< over the window
  };
  /// @param t0  request sent, station clock    @param t1  request received, robot clock
  /// @param t2  answer sent, robot clock       @param t3  answer received, station clock; ns each.
  /// Exchanges that contradict causality (t3 < t0, t2 < t1, negative round trip) are ignored.
  void add(std::int64_t t0, std::int64_t t1, std::int64_t t2, std::int64_t t3);
  [[nodiscard]] std::optional<Estimate> estimate() const { return estimate_; }
  [[nodiscard]] std::optional<std::int64_t> toRobot(std::int64_t station_ns) const;
  [[nodiscard]] std::optional<std::int64_t> toStation(std::int64_t robot_ns) const;
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  void reset();

 private:
  struct Sample {
    std::int64_t station_ns = 0;  ///< middle of the exchange
    std::int64_t offset_ns = 0;
    double half_rtt_s = 0.0;
  };
  [[nodiscard]] double predicted(std::int64_t station_ns) const;  ///< offset, ns
  void fit();

  std::deque<Sample> samples_;
  std::optional<Estimate> estimate_;
  std::int64_t reference_ns_ = 0;  ///< station time at which estimate_ holds
  std::uint64_t steps_ = 0;
};

}  // namespace kiln
