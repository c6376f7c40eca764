#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace kiln {

struct MotionLimits {
  double accel = 1.0;  ///< unit/s^2, > 0
  double jerk = 10.0;  ///< unit/s^3, > 0
};

/// Largest acceleration towards a speed that is `error` > 0 away such that, falling by jerk * dt a
/// step, it ends at zero without passing the target. For a sampled ramp a dt + a^2 / (2 j) - a dt /
/// 2 = error, and a last step that is not a whole one needs up to j dt^2 / 8 more.
[[nodiscard]] inline double approachAcceleration(double error, const MotionLimits& limits,
                                                 double dt) {
  const double whole_step = limits.jerk * dt * dt;
  if (error <= whole_step) return std::min(error / dt, limits.accel);
  const double h = 0.5 * limits.jerk * dt;
  const double curve = -h + std::sqrt(h * h + 2.0 * limits.jerk * (error - 0.125 * whole_step));
  return std::min(curve, limits.accel);
}

/// Brings a velocity vector to a target along a straight line in velocity space, with the norm of
/// acceleration and jerk limited. A ramp to zero therefore keeps its direction: a swerve base
/// brakes without turning its wheels. Limits may change at any step: an acceleration that began
/// under a higher jerk is taken back under it, else it would carry past the target.
template <int N>
class JerkLimiter {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  /// One step of dt > 0 towards `target`. `feed_forward` is the target's own acceleration, if
  /// known.
  const Vector& step(const Vector& target, const MotionLimits& limits, double dt,
                     const Vector& feed_forward = Vector::Zero()) {
    const Vector error = target - velocity_ - feed_forward * dt;
    const double size = error.norm();
    Vector wanted = feed_forward;
    if (size > 1e-12) wanted += error * (approachAcceleration(size, limits, dt) / size);
    if (wanted.norm() > limits.accel) wanted *= limits.accel / wanted.norm();
    Vector change = wanted - acceleration_;
    const bool takes_back = acceleration_.dot(change) < 0.0;
    jerk_ = takes_back ? std::max(jerk_, limits.jerk) : limits.jerk;
    const double max_change = jerk_ * dt;
    if (change.norm() > max_change) change *= max_change / change.norm();
    acceleration_ += change;
    velocity_ += acceleration_ * dt;
    if ((target - velocity_).norm() < 1e-9 && feed_forward.isZero()) {
      velocity_ = target;
      if (acceleration_.norm() <= max_change) acceleration_.setZero();
    }
    return velocity_;
  }
  void reset(const Vector& velocity = Vector::Zero()) {
    velocity_ = velocity;
    acceleration_.setZero();
    jerk_ = 0.0;
  }
  [[nodiscard]] const Vector& velocity() const { return velocity_; }
  [[nodiscard]] const Vector& acceleration() const { return acceleration_; }

 private:
  Vector velocity_ = Vector::Zero();
  Vector acceleration_ = Vector::Zero();
  double jerk_ = 0.0;  ///< limit under which the acceleration has grown
};

}  // namespace kiln
