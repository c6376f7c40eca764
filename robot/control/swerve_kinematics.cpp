#include "robot/control/swerve_kinematics.h"

#include <cmath>

#include <Eigen/Dense>

#include "common/core/units.h"

namespace kiln {
namespace {

// Beyond this angle a solution costs extra, so that wheels are not parked at the end of their
// range, where the next small change of direction would need half a turn.
constexpr double kComfortableSteer = 100.0 * kDeg;

Eigen::Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

SwerveKinematics::SwerveKinematics(const RobotGeometry& robot)
    : wheel_position_{Eigen::Vector2d(robot.wheel_x_m, robot.wheel_y_m),
                      Eigen::Vector2d(robot.wheel_x_m, -robot.wheel_y_m),
                      Eigen::Vector2d(-robot.wheel_x_m, robot.wheel_y_m),
                      Eigen::Vector2d(-robot.wheel_x_m, -robot.wheel_y_m)},
      wheel_radius_m_(robot.wheel_radius_m),
      steer_limit_rad_(robot.steer_limit_deg * kDeg),
      steer_rate_radps_(robot.steer_rate_deg_s * kDeg),
      lever_arm_m_(std::hypot(robot.wheel_x_m, robot.wheel_y_m)) {
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d& p = wheel_position_[static_cast<std::size_t>(i)];
    design_.row(2 * i) << 1.0, 0.0, -p.y();
    design_.row(2 * i + 1) << 0.0, 1.0, p.x();
  }
  pseudo_inverse_ = (design_.transpose() * design_).inverse() * design_.transpose();
}

Eigen::Vector2d SwerveKinematics::wheelVelocity(std::size_t i, const Twist2& twist) const {
  const Eigen::Vector2d& p = wheel_position_[i];
  return {twist.vx_mps - twist.wz_radps * p.y(), twist.vy_mps + twist.wz_radps * p.x()};
}

double SwerveKinematics::chooseAngle(double direction_rad, double steer_rad) const {
  const double ahead = wrapAngle(direction_rad);
  double best = steer_rad;
  double best_cost = INFINITY;
  for (const double candidate : {ahead, ahead - M_PI, ahead + M_PI}) {
    if (std::abs(candidate) > steer_limit_rad_ + 1e-9) continue;
    const double reach = std::max(0.0, std::abs(candidate) - kComfortableSteer);
    const double cost = std::abs(candidate - steer_rad) + 0.5 * reach;
    if (cost < best_cost) {
      best_cost = cost;
      best = candidate;
    }
  }
  return best;
}

WheelCommands SwerveKinematics::inverse(const Twist2& twist, const std::array<double, 4>& steer,
                                        double min_wheel_speed_mps) const {
  WheelCommands out;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d v = wheelVelocity(i, twist);
    out[i].steer_rad =
        v.norm() < min_wheel_speed_mps ? steer[i] : chooseAngle(std::atan2(v.y(), v.x()), steer[i]);
    // The projection carries the sign (reversed drive) and is all that a slow wheel off its angle
    // can give.
    out[i].drive_radps = v.dot(direction(out[i].steer_rad)) / wheel_radius_m_;
  }
  return out;
}

Eigen::Vector3d SwerveKinematics::solve(const Eigen::Matrix<double, 8, 1>& wheel_velocities) const {
  return pseudo_inverse_ * wheel_velocities;
}

SwerveTwist SwerveKinematics::forward(const WheelStates& wheels) const {
  Eigen::Matrix<double, 8, 1> b;
  for (int i = 0; i < 4; ++i) {
    const WheelState& wheel = wheels[static_cast<std::size_t>(i)];
    b.segment<2>(2 * i) = wheel.drive_radps * wheel_radius_m_ * direction(wheel.steer_rad);
  }
  const Eigen::Vector3d x = solve(b);
  return {{x[0], x[1], x[2]}, std::sqrt((design_ * x - b).squaredNorm() / 8.0)};
}

Pose2 SwerveKinematics::motionBetween(const WheelStates& before, const WheelStates& after) const {
  Eigen::Matrix<double, 8, 1> b;
  for (std::size_t i = 0; i < 4; ++i) {
    const double path = (after[i].drive_angle_rad - before[i].drive_angle_rad) * wheel_radius_m_;
    const double steer = 0.5 * (before[i].steer_rad + after[i].steer_rad);
    b.segment<2>(2 * static_cast<Eigen::Index>(i)) = path * direction(steer);
  }
  const Eigen::Vector3d x = solve(b);
  return planarArc(x[0], x[1], x[2]);
}

Pose2 planarArc(double dx_m, double dy_m, double dyaw_rad) {
  double s = 1.0;  // sin(a)/a
  double c = 0.0;  // (1 - cos(a))/a
  if (std::abs(dyaw_rad) > 1e-6) {
    s = std::sin(dyaw_rad) / dyaw_rad;
    c = (1.0 - std::cos(dyaw_rad)) / dyaw_rad;
  } else {
    c = 0.5 * dyaw_rad;
  }
  return {s * dx_m - c * dy_m, c * dx_m + s * dy_m, wrapAngle(dyaw_rad)};
}

}  // namespace kiln
