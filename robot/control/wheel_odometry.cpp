#include "robot/control/wheel_odometry.h"

#include <cmath>

namespace kiln {

bool isFinite(const BaseState& state) {
  for (const WheelState& wheel : state.wheels) {
    if (!std::isfinite(wheel.steer_rad) || !std::isfinite(wheel.drive_radps) ||
        !std::isfinite(wheel.drive_angle_rad)) {
      return false;
    }
  }
  return true;
}

void WheelOdometry::update(const SwerveKinematics& kinematics, const BaseState& state) {
  if (!isFinite(state)) {
    ++skipped_;
    return;
  }
  if (last_ && state.stamp <= last_->stamp) return;
  if (last_) {
    const double reach = max_speed_mps_ * toSeconds(state.stamp - last_->stamp);
    bool plausible = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const double path = (state.wheels[i].drive_angle_rad - last_->wheels[i].drive_angle_rad) *
                          kinematics.wheelRadius();
      if (std::abs(path) > reach) plausible = false;
    }
    if (plausible) {
      X_odom_base_ = X_odom_base_ * kinematics.motionBetween(last_->wheels, state.wheels);
    } else {
      ++skipped_;
    }
  }
  last_ = state;
}

}  // namespace kiln
