#pragma once

#include <chrono>

namespace kiln {

/// Wall-speed time for link housekeeping (poll timeouts, heartbeats, ages), apart from robot time,
/// which may be simulated. std::chrono's clock may be read in this folder and in core/clock.cpp
/// alone.
using Monotonic = std::chrono::steady_clock;

[[nodiscard]] inline Monotonic::time_point monotonicNow() { return Monotonic::now(); }
[[nodiscard]] inline double secondsBetween(Monotonic::time_point from, Monotonic::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace kiln
