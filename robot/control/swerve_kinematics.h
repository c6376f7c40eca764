#pragma once

#include <array>

#include <Eigen/Core>

#include "common/geom/pose.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/hal/drive_base.h"

namespace kiln {

using WheelStates = std::array<WheelState, 4>;

/// Rigid motion that explains the wheels best, and how badly it does.
struct SwerveTwist {
  Twist2 twist;  ///< base frame
  double residual_mps =
      0;  ///< rms over the eight wheel velocity components: slip, or a wheel off its angle
};

/// Kinematics of four steered wheels at (+-x, +-y): front-left, front-right, rear-left, rear-right.
/// Steering is a limited range (+-180 deg, no turning through), so each direction has one or two
/// angles: the wheel's own and the opposite one with the drive reversed. Pure functions of their
/// arguments; thread-safe.
class SwerveKinematics {
 public:
  explicit SwerveKinematics(const RobotGeometry& robot);

  /// Velocity of wheel i's contact over the ground, base frame, m/s.
  [[nodiscard]] Eigen::Vector2d wheelVelocity(std::size_t i, const Twist2& twist) const;
  /// Wheel commands for a twist.
  /// @param steer  where the wheels point now (or were last told to), rad; decides between an angle
  /// and its opposite.
  /// @param min_wheel_speed_mps  slower wheels keep `steer`: at rest a direction has no meaning.
  [[nodiscard]] WheelCommands inverse(const Twist2& twist, const std::array<double, 4>& steer,
                                      double min_wheel_speed_mps) const;
  /// Twist by least squares from measured steering and drive speed.
  [[nodiscard]] SwerveTwist forward(const WheelStates& wheels) const;
  /// Motion of the base between two measurements: least squares over the wheels' paths, then the
  /// exact arc.
  [[nodiscard]] Pose2 motionBetween(const WheelStates& before, const WheelStates& after) const;

  [[nodiscard]] double wheelRadius() const { return wheel_radius_m_; }
  [[nodiscard]] double steerRate() const { return steer_rate_radps_; }
  /// Distance of the steering axes from the base centre: turns yaw rates into comparable metres per
  /// second.
  [[nodiscard]] double leverArm() const { return lever_arm_m_; }

 private:
  [[nodiscard]] Eigen::Vector3d solve(const Eigen::Matrix<double, 8, 1>& wheel_velocities) const;
  [[nodiscard]] double chooseAngle(double direction_rad, double steer_rad) const;

  std::array<Eigen::Vector2d, 4> wheel_position_;
  Eigen::Matrix<double, 8, 3> design_;
  Eigen::Matrix<double, 3, 8> pseudo_inverse_;
  double wheel_radius_m_, steer_limit_rad_, steer_rate_radps_, lever_arm_m_;
};

/// exp of a planar twist: the pose after moving along (dx, dy) while turning by dyaw, all at
/// constant rates.
[[nodiscard]] Pose2 planarArc(double dx_m, double dy_m, double dyaw_rad);

}  // namespace kiln
