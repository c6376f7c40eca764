#include "robot/app/state_history.h"

#include <algorithm>

namespace kiln {
namespace {

constexpr Duration kExtrapolation = std::chrono::milliseconds(50);
constexpr Duration kGoesOn = std::chrono::milliseconds(10);

RobotSample blend(const RobotSample& a, const RobotSample& b, Stamp stamp) {
  const double s = toSeconds(stamp - a.stamp) / toSeconds(b.stamp - a.stamp);
  RobotSample out;
  out.stamp = stamp;
  out.q = (1.0 - s) * a.q + s * b.q;
  out.X_odom_base.x_m = (1.0 - s) * a.X_odom_base.x_m + s * b.X_odom_base.x_m;
  out.X_odom_base.y_m = (1.0 - s) * a.X_odom_base.y_m + s * b.X_odom_base.y_m;
  out.X_odom_base.yaw_rad = wrapAngle(a.X_odom_base.yaw_rad +
                                      s * wrapAngle(b.X_odom_base.yaw_rad - a.X_odom_base.yaw_rad));
  return out;
}

}  // namespace

void StateHistory::add(const RobotSample& sample) {
  const std::lock_guard lock(mutex_);
  if (!samples_.empty() && sample.stamp <= samples_.back().stamp) return;
  samples_.push_back(sample);
  while (samples_.front().stamp < sample.stamp - span_) samples_.pop_front();
}

std::optional<RobotSample> StateHistory::at(Stamp stamp) const {
  const std::lock_guard lock(mutex_);
  if (samples_.empty() || stamp < samples_.front().stamp) return std::nullopt;
  if (stamp >= samples_.back().stamp) {
    if (stamp > samples_.back().stamp + kExtrapolation) return std::nullopt;
    if (samples_.size() < 2) return samples_.back();
    const RobotSample &a = samples_[samples_.size() - 2], &b = samples_.back();
    if (b.stamp - a.stamp > kExtrapolation) return b;
    RobotSample ahead = blend(a, b, std::min(stamp, b.stamp + kGoesOn));
    ahead.stamp = stamp;
    return ahead;
  }
  const auto after =
      std::upper_bound(samples_.begin(), samples_.end(), stamp,
                       [](Stamp t, const RobotSample& sample) { return t < sample.stamp; });
  return blend(*(after - 1), *after, stamp);
}

std::optional<RobotSample> StateHistory::newest() const {
  const std::lock_guard lock(mutex_);
  if (samples_.empty()) return std::nullopt;
  return samples_.back();
}

void StateHistory::clear() {
  const std::lock_guard lock(mutex_);
  samples_.clear();
}

}  // namespace kiln
