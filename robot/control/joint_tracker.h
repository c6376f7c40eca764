#pragma once

#include <array>

#include "common/geom/pose.h"
#include "robot/control/jerk_limiter.h"

namespace kiln {

/// Commanded motion of the six joints: position, speed and acceleration that never step. Each joint
/// is limited by itself. Thread-compatible.
class JointTracker {
 public:
  /// Where a trajectory is now.
  struct Reference {
    Vector6d q = Vector6d::Zero();
    Vector6d qd = Vector6d::Zero();
    Vector6d qdd = Vector6d::Zero();
  };

  void reset(const Vector6d& q) {
    q_ = q;
    for (auto& joint : joints_) joint.reset();
  }
  /// Ramps towards a joint velocity; zero is the stop.
  void stepVelocity(const Vector6d& qd, const MotionLimits& limits, double dt) {
    step(qd, Vector6d::Zero(), limits, dt);
  }
  /// Follows a reference: feed-forward plus gain * error, both within `max_speed`.
  void stepReference(const Reference& ref, double gain, const Vector6d& max_speed,
                     const MotionLimits& limits, double dt) {
    const Vector6d wish = ref.qd + gain * (ref.q - (q_ + velocity() * dt));
    step(wish.cwiseMax(-max_speed).cwiseMin(max_speed), ref.qdd, limits, dt);
  }
  [[nodiscard]] const Vector6d& position() const { return q_; }
  [[nodiscard]] Vector6d velocity() const {
    Vector6d v;
    for (int i = 0; i < 6; ++i) v[i] = joints_[static_cast<std::size_t>(i)].velocity()[0];
    return v;
  }

 private:
  void step(const Vector6d& qd, const Vector6d& qdd, const MotionLimits& limits, double dt) {
    for (int i = 0; i < 6; ++i) {
      JerkLimiter<1>& joint = joints_[static_cast<std::size_t>(i)];
      joint.step(JerkLimiter<1>::Vector(qd[i]), limits, dt, JerkLimiter<1>::Vector(qdd[i]));
      q_[i] += joint.velocity()[0] * dt;
    }
  }

  Vector6d q_ = Vector6d::Zero();
  std::array<JerkLimiter<1>, 6> joints_;
};

}  // namespace kiln
