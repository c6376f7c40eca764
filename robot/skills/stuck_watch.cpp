#include "robot/skills/stuck_watch.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {
constexpr double kLeastWay_m = 0.25;  // commanded; less proves nothing
}

void StuckWatch::restart(Stamp now, const Pose2& X_map_base) {
  begin_ = now;
  from_ = X_map_base;
  commanded_m_ = measured_m_ = 0.0;
}

double StuckWatch::speed(const Twist2& twist) const {
  return std::hypot(twist.vx_mps, twist.vy_mps, config_.lever_m * twist.wz_radps);
}

bool StuckWatch::update(Stamp now, double dt_s, const Pose2& X_map_base, const Twist2& commanded,
                        const Twist2& measured) {
  commanded_m_ += speed(commanded) * dt_s;
  measured_m_ += speed(measured) * dt_s;
  if (toSeconds(now - begin_) < config_.window_s) return false;
  const double moved_m = std::hypot(X_map_base.x_m - from_.x_m, X_map_base.y_m - from_.y_m) +
                         config_.lever_m * std::abs(wrapAngle(X_map_base.yaw_rad - from_.yaw_rad));
  const bool stuck =
      commanded_m_ > kLeastWay_m && std::min(moved_m, measured_m_) < config_.ratio * commanded_m_;
  restart(now, X_map_base);
  return stuck;
}

}  // namespace kiln
