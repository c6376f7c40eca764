#include "robot/planning/path_timing.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

// The averaging window carries speed into a narrow slow place; where the limit is low, acceleration
// is kept low too, so that no more than about a quarter of the limit is carried in.
constexpr double kCarriedSpeed = 0.5;

/// Fastest v(s), zero at both ends.
std::vector<double> speedProfile(std::vector<PathTiming::Sample> samples, double window_s) {
  for (PathTiming::Sample& sample : samples) {
    sample.max_accel =
        std::min(sample.max_accel, kCarriedSpeed * sample.max_speed / std::max(window_s, 1e-3));
  }
  const std::size_t n = samples.size();
  std::vector<double> v(n);
  for (std::size_t k = 0; k < n; ++k) v[k] = samples[k].max_speed;
  v.front() = v.back() = 0.0;
  const auto reachable = [&](std::size_t from, std::size_t to, std::size_t limit) {
    const double ds = std::abs(samples[to].s - samples[from].s);
    const double accel = std::min(samples[from].max_accel, samples[limit].max_accel);
    return std::sqrt(v[from] * v[from] + 2.0 * accel * ds);
  };
  for (std::size_t k = 1; k < n; ++k) v[k] = std::min(v[k], reachable(k - 1, k, k));
  for (std::size_t k = n - 1; k-- > 0;) v[k] = std::min(v[k], reachable(k + 1, k, k));
  return v;
}

}  // namespace

PathTiming::PathTiming(const std::vector<Sample>& samples, double jerk_time_s)
    : length_(samples.back().s) {
  const std::vector<double> v = speedProfile(samples, jerk_time_s);
  Knot knot;
  knot.s = samples.front().s;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double ds = samples[k].s - samples[k - 1].s;
    const double sum = v[k] + v[k - 1];
    if (ds <= 0.0 || sum <= 0.0) continue;
    const double dt = 2.0 * ds / sum;
    knot.accel = (v[k] - v[k - 1]) / dt;
    knots_.push_back(knot);
    knot.integral += knot.s * dt + knot.v * dt * dt / 2.0 + knot.accel * dt * dt * dt / 6.0;
    knot.t += dt;
    knot.s = samples[k].s;
    knot.v = v[k];
  }
  knot.v = knot.accel = 0.0;
  knots_.push_back(knot);
  window_ = knot.t > 0.0 ? jerk_time_s : 0.0;
  duration_ = knot.t + window_;
}

const PathTiming::Knot& PathTiming::knotBefore(double t) const {
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), t,
                                      [](double time, const Knot& k) { return time < k.t; });
  return after == knots_.begin() ? knots_.front() : *(after - 1);
}

double PathTiming::rawPosition(double t) const {
  if (t <= 0.0) return knots_.front().s;
  const Knot& k = knotBefore(t);
  const double dt = t - k.t;
  return k.s + k.v * dt + 0.5 * k.accel * dt * dt;
}

double PathTiming::rawIntegral(double t) const {
  if (t <= 0.0) return knots_.front().s * t;
  const Knot& k = knotBefore(t);
  const double dt = t - k.t;
  return k.integral + k.s * dt + k.v * dt * dt / 2.0 + k.accel * dt * dt * dt / 6.0;
}

PathPoint PathTiming::at(double t_s) const {
  if (knots_.empty()) return {};
  if (t_s <= 0.0) return {knots_.front().s, 0.0};
  if (t_s >= duration_) return {length_, 0.0};
  if (window_ <= 0.0) return {rawPosition(t_s), knotBefore(t_s).v};
  return {(rawIntegral(t_s) - rawIntegral(t_s - window_)) / window_,
          (rawPosition(t_s) - rawPosition(t_s - window_)) / window_};
}

}  // namespace kiln
