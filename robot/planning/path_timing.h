#pragma once

#include <vector>

namespace kiln {

/// Along a path of given length: where, and how fast, at a time.
struct PathPoint {
  double s = 0.0;
  double speed = 0.0;
};

/// Rest-to-rest motion along a path whose speed and acceleration limits vary on the way.
///
/// Fastest speed profile under the limits (forward and backward pass over v^2), then averaged over
/// a sliding window of `jerk_time_s`: the steps of acceleration become ramps, so jerk <= 2 accel /
/// jerk_time, at the price of that much more time. The position ends exactly at the last sample.
/// Thread-compatible.
class PathTiming {
 public:
  struct Sample {
    double s = 0.0;          ///< path coordinate, not decreasing
    double max_speed = 1.0;  ///< > 0
    double max_accel = 1.0;  ///< > 0
  };
  PathTiming() = default;
  /// @param samples  at least two, dense enough for the limits to be taken as constant between
  /// them.
  PathTiming(const std::vector<Sample>& samples, double jerk_time_s);
  [[nodiscard]] double duration() const { return duration_; }
  /// Clamped to the ends.
  [[nodiscard]] PathPoint at(double t_s) const;

 private:
  struct Knot {
    double t = 0.0, s = 0.0, v = 0.0, accel = 0.0;
    double integral = 0.0;  ///< of s over time up to t
  };
  [[nodiscard]] const Knot& knotBefore(double t) const;
  [[nodiscard]] double rawPosition(double t) const;
  [[nodiscard]] double rawIntegral(double t) const;

  std::vector<Knot> knots_;
  double window_ = 0.0, duration_ = 0.0, length_ = 0.0;
};

}  // namespace kiln
