#pragma once

#include "common/core/clock.h"

namespace kiln {

/// The clock of another computer: off by so much, and by more with time. Thread-safe.
class SkewedClock final : public Clock {
 public:
  /// @param drift_ppm  gains so many microseconds a second from now on.
  SkewedClock(Duration offset, double drift_ppm)
      : offset_(offset), drift_ppm_(drift_ppm), start_(clock_.now()) {}
  [[nodiscard]] Stamp now() const override {
    const Stamp t = clock_.now();
    return t + offset_ + fromSeconds(1e-6 * drift_ppm_ * toSeconds(t - start_));
  }

 private:
  SteadyClock clock_;
  Duration offset_;
  double drift_ppm_;
  Stamp start_;
};

}  // namespace kiln
