#pragma once

#include <algorithm>
#include <optional>

#include "common/core/stamp.h"

namespace kiln {

/// Maps world time to the daemon's clock: the least (arrival - world time) of the last one to two
/// windows. Transport only ever delays, so the least difference is nearest to the truth, and no
/// mapped stamp lies in the future. A world whose clock waits for a slow machine says for how long
/// (`slipped`), and is followed at once: else every stamp would look that much too old, and the
/// controllers would stop for data that is fresh. Thread-compatible.
class ClockMap {
 public:
  explicit ClockMap(Duration window = std::chrono::seconds(1)) : window_(window) {}
  void restart() { *this = ClockMap(window_); }
  void observe(Stamp arrival, Stamp world, Duration slipped = {}) {
    slipped_ = slipped;
    const Duration difference = arrival - world - slipped;
    if (!window_start_ || arrival - *window_start_ > window_) {
      previous_ = window_start_ ? current_ : difference;
      current_ = difference;
      window_start_ = arrival;
    }
    current_ = std::min(current_, difference);
  }
  /// To add to the stamps of the report that was observed last.
  [[nodiscard]] Duration shift() const { return std::min(previous_, current_) + slipped_; }

 private:
  Duration window_;
  std::optional<Stamp> window_start_;
  Duration previous_{}, current_{}, slipped_{};
};

}  // namespace kiln
