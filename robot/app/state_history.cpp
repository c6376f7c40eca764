#include "robot/app/state_history.h"

#include <algorithm>

namespace kiln {
namespace {

constexpr Duration kExtrapolation = std::chrono::milliseconds(50);
constexpr Duration kGoesOn = std::chrono::milliseconds(10);

Vector6d blend(const Vector6d& a, const Vector6d& b, double s) { return (1.0 - s) * a + s * b; }

Pose2 blend(const Pose2& a, const Pose2& b, double s) {
  return {(1.0 - s) * a.x_m + s * b.x_m, (1.0 - s) * a.y_m + s * b.y_m,
          wrapAngle(a.yaw_rad + s * wrapAngle(b.yaw_rad - a.yaw_rad))};
}

template <class T>
using Series = std::deque<std::pair<Stamp, T>>;

template <class T>
void append(Series<T>& series, Stamp stamp, const T& value, Duration span) {
  if (!series.empty() && stamp <= series.back().first) return;
  series.emplace_back(stamp, value);
  while (series.front().first < stamp - span) series.pop_front();
}

template <class T>
T between(const std::pair<Stamp, T>& a, const std::pair<Stamp, T>& b, Stamp stamp) {
  return blend(a.second, b.second, toSeconds(stamp - a.first) / toSeconds(b.first - a.first));
}

template <class T>
std::optional<T> valueAt(const Series<T>& series, Stamp stamp) {
  if (series.empty() || stamp < series.front().first) return std::nullopt;
  const auto& newest = series.back();
  if (stamp >= newest.first) {
    if (stamp > newest.first + kExtrapolation) return std::nullopt;
    if (series.size() < 2) return newest.second;
    const auto& before = series[series.size() - 2];
    if (newest.first - before.first > kExtrapolation) return newest.second;
    return between(before, newest, std::min(stamp, newest.first + kGoesOn));
  }
  const auto after = std::upper_bound(series.begin(), series.end(), stamp,
                                      [](Stamp t, const auto& entry) { return t < entry.first; });
  return between(*(after - 1), *after, stamp);
}

}  // namespace

void StateHistory::addJoints(Stamp stamp, const Vector6d& q) {
  const std::lock_guard lock(mutex_);
  append(joints_, stamp, q, span_);
}

void StateHistory::addOdometry(Stamp stamp, const Pose2& X_odom_base) {
  const std::lock_guard lock(mutex_);
  append(odometry_, stamp, X_odom_base, span_);
}

std::optional<RobotSample> StateHistory::at(Stamp stamp) const {
  const std::lock_guard lock(mutex_);
  const auto q = valueAt(joints_, stamp);
  const auto X_odom_base = valueAt(odometry_, stamp);
  if (!q || !X_odom_base) return std::nullopt;
  return RobotSample{stamp, *q, *X_odom_base};
}

void StateHistory::clear() {
  const std::lock_guard lock(mutex_);
  joints_.clear();
  odometry_.clear();
}

}  // namespace kiln
