#include "common/transport/clock_sync.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kiln {
namespace {

constexpr std::size_t kWindow = 64;     // 13 s at 5 Hz
constexpr double kGoodRttFactor = 1.5;  // of the shortest half round trip
constexpr double kGoodRttMargin_s = 0.0002;
constexpr double kStepMargin_s = 0.002;
constexpr std::size_t kDriftSamples = 16;
constexpr double kDriftSpan_s = 5.0;
constexpr double kMaxDrift = 500e-6;

}  // namespace

void ClockSync::reset() {
  samples_.clear();
  estimate_.reset();
}

double ClockSync::predicted(std::int64_t station_ns) const {
  return estimate_->offset_s * 1e9 +
         estimate_->drift_ppm * 1e-6 * static_cast<double>(station_ns - reference_ns_);
}

void ClockSync::add(std::int64_t t0, std::int64_t t1, std::int64_t t2, std::int64_t t3) {
  const std::int64_t rtt_ns = (t3 - t0) - (t2 - t1);
  if (t3 < t0 || t2 < t1 || rtt_ns < 0) return;
  const Sample sample{t0 + (t3 - t0) / 2, ((t1 - t0) + (t2 - t3)) / 2,
                      static_cast<double>(rtt_ns) * 0.5e-9};
  if (estimate_) {
    const double error_s =
        std::abs(static_cast<double>(sample.offset_ns) - predicted(sample.station_ns)) * 1e-9;
    if (error_s > sample.half_rtt_s + estimate_->uncertainty_s + kStepMargin_s) {
      ++steps_;
      samples_.clear();
    }
  }
  samples_.push_back(sample);
  if (samples_.size() > kWindow) samples_.pop_front();
  fit();
}

void ClockSync::fit() {
  const double best =
      std::min_element(samples_.begin(), samples_.end(), [](const Sample& a, const Sample& b) {
        return a.half_rtt_s < b.half_rtt_s;
      })->half_rtt_s;
  const std::int64_t t_ref = samples_.back().station_ns;
  const std::int64_t o_ref = samples_.back().offset_ns;
  double n = 0, st = 0, so = 0, stt = 0, sto = 0, t_min = 0;
  for (const Sample& s : samples_) {
    if (s.half_rtt_s > best * kGoodRttFactor + kGoodRttMargin_s) continue;
    const double t = static_cast<double>(s.station_ns - t_ref) * 1e-9;
    const double o = static_cast<double>(s.offset_ns - o_ref) * 1e-9;
    n += 1, st += t, so += o, stt += t * t, sto += t * o;
    t_min = std::min(t_min, t);
  }
  const double determinant = n * stt - st * st;
  double drift = 0.0;
  if (n >= kDriftSamples && -t_min >= kDriftSpan_s && determinant > 0.0) {
    drift = std::clamp((n * sto - st * so) / determinant, -kMaxDrift, kMaxDrift);
  }
  std::vector<double> rtts;
  for (const Sample& s : samples_) rtts.push_back(2.0 * s.half_rtt_s);
  const auto p95 =
      rtts.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(rtts.size() - 1));
  std::nth_element(rtts.begin(), p95, rtts.end());
  Estimate estimate;
  estimate.offset_s = static_cast<double>(o_ref) * 1e-9 + (so - drift * st) / n;
  estimate.drift_ppm = drift * 1e6;
  // Half the shortest round trip bounds the asymmetry; without a drift estimate old samples may be
  // off by kMaxDrift.
  estimate.uncertainty_s = best + (drift == 0.0 ? -t_min * 50e-6 : 0.0);
  estimate.rtt_s = 2.0 * samples_.back().half_rtt_s;
  estimate.rtt_p95_s = *p95;
  estimate_ = estimate;
  reference_ns_ = t_ref;
}

std::optional<std::int64_t> ClockSync::toRobot(std::int64_t station_ns) const {
  if (!estimate_) return std::nullopt;
  return station_ns + std::llround(predicted(station_ns));
}

std::optional<std::int64_t> ClockSync::toStation(std::int64_t robot_ns) const {
  if (!estimate_) return std::nullopt;
  const std::int64_t first = robot_ns - std::llround(estimate_->offset_s * 1e9);
  return robot_ns - std::llround(predicted(first));
}

}  // namespace kiln
