#include "robot/skills/stuck_watch.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {
constexpr double kLeastWay_m = 0.25;  // commanded; less proves nothing
}

void StuckWatch::restart(Stamp now, const Pose2& X_map_base) { samples_ = {{now, X_map_base}}; }

double StuckWatch::speed(const Twist2& twist) const {
  return std::hypot(twist.vx_mps, twist.vy_mps, config_.lever_m * twist.wz_radps);
}

bool StuckWatch::update(Stamp now, double dt_s, const Pose2& X_map_base, const Twist2& commanded,
                        const Twist2& measured) {
  samples_.push_back({now, X_map_base, samples_.back().commanded_m + speed(commanded) * dt_s,
                      samples_.back().measured_m + speed(measured) * dt_s});
  if (toSeconds(now - samples_.front().stamp) < config_.window_s) return false;
  const Sample from = samples_.front();
  samples_.pop_front();
  const double commanded_m = samples_.back().commanded_m - from.commanded_m;
  const double measured_m = samples_.back().measured_m - from.measured_m;
  const Pose2& to = X_map_base;
  const double moved_m =
      std::hypot(to.x_m - from.X_map_base.x_m, to.y_m - from.X_map_base.y_m) +
      config_.lever_m * std::abs(wrapAngle(to.yaw_rad - from.X_map_base.yaw_rad));
  return commanded_m > kLeastWay_m && std::min(moved_m, measured_m) < config_.ratio * commanded_m;
}

}  // namespace kiln
