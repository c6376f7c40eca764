#pragma once

#include <chrono>
#include <cstdint>

namespace kiln {

/// Tag type of robot time: nanoseconds since the robot's own epoch (boot, simulation start or
/// recording start). It has no now(): a Clock& is injected instead.
struct RobotClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<RobotClock, duration>;
  static constexpr bool is_steady = true;
};

using Stamp = RobotClock::time_point;
using Duration = RobotClock::duration;

/// Seconds as a double, for formulas and display only; never accumulate it.
[[nodiscard]] constexpr double toSeconds(Duration d) {
  return static_cast<double>(d.count()) * 1e-9;
}
[[nodiscard]] constexpr double toSeconds(Stamp t) { return toSeconds(t.time_since_epoch()); }

/// Rounds to the nearest nanosecond.
[[nodiscard]] constexpr Duration fromSeconds(double s) {
  return Duration{static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5))};
}
[[nodiscard]] constexpr std::int64_t toNanoseconds(Stamp t) { return t.time_since_epoch().count(); }
[[nodiscard]] constexpr Stamp stampFromNanoseconds(std::int64_t ns) { return Stamp{Duration{ns}}; }

}  // namespace kiln
