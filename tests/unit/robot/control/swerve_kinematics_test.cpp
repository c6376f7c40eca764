#include "robot/control/swerve_kinematics.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/control/wheel_odometry.h"

namespace kiln {
namespace {

WheelStates follow(const WheelCommands& commands) {
  WheelStates wheels;
  for (std::size_t i = 0; i < 4; ++i) {
    wheels[i].steer_rad = commands[i].steer_rad;
    wheels[i].drive_radps = commands[i].drive_radps;
  }
  return wheels;
}

TEST(SwerveKinematics, ForwardUndoesInverseForRandomTwistsAndSteering) {
  const SwerveKinematics kinematics{RobotGeometry{}};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const Twist2 twist{unit(random), unit(random), unit(random)};
    std::array<double, 4> steer;
    for (double& angle : steer) angle = M_PI * unit(random);
    const WheelCommands commands = kinematics.inverse(twist, steer, 1e-6);
    for (const WheelCommand& c : commands) ASSERT_LE(std::abs(c.steer_rad), M_PI + 1e-9);
    const SwerveTwist back = kinematics.forward(follow(commands));
    ASSERT_NEAR(back.twist.vx_mps, twist.vx_mps, 1e-9);
    ASSERT_NEAR(back.twist.vy_mps, twist.vy_mps, 1e-9);
    ASSERT_NEAR(back.twist.wz_radps, twist.wz_radps, 1e-9);
    ASSERT_NEAR(back.residual_mps, 0.0, 1e-9);
  }
}

TEST(SwerveKinematics, ReversesTheDriveInsteadOfTurningTheWheelsAround) {
  const SwerveKinematics kinematics{RobotGeometry{}};
  const auto back = kinematics.inverse({-0.5, 0, 0}, {0, 0, 0, 0}, 1e-3);
  for (const WheelCommand& c : back) {
    EXPECT_NEAR(c.steer_rad, 0.0, 1e-9);
    EXPECT_NEAR(c.drive_radps, -0.5 / 0.085, 1e-9);
  }
}

TEST(SwerveKinematics, NeverTurnsThroughTheEndOfTheRange) {
  const SwerveKinematics kinematics{RobotGeometry{}};
  const double at = 170 * kDeg;
  // -170 deg is 20 deg away on the circle, but 340 deg of travel: 10 deg and reversed drive is
  // nearer (160 deg).
  const auto c = kinematics.inverse({std::cos(-at), std::sin(-at), 0}, {at, at, at, at}, 1e-3);
  for (const WheelCommand& wheel : c) {
    EXPECT_NEAR(wheel.steer_rad, 10 * kDeg, 1e-9);
    EXPECT_LT(wheel.drive_radps, 0.0);
  }
}

TEST(SwerveKinematics, KeepsTheAnglesAtRest) {
  const SwerveKinematics kinematics{RobotGeometry{}};
  const std::array<double, 4> steer{0.3, -1.2, 2.0, -3.0};
  const auto c = kinematics.inverse({1e-5, -1e-5, 0}, steer, 0.004);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(c[i].steer_rad, steer[i]);
}

TEST(SwerveKinematics, ResidualTellsAWheelOffItsAngle) {
  const SwerveKinematics kinematics{RobotGeometry{}};
  WheelStates wheels = follow(kinematics.inverse({1, 0, 0}, {0, 0, 0, 0}, 1e-3));
  EXPECT_LT(kinematics.forward(wheels).residual_mps, 1e-9);
  wheels[0].steer_rad += 20 * kDeg;
  EXPECT_GT(kinematics.forward(wheels).residual_mps, 0.05);
}

TEST(WheelOdometry, FollowsACircleExactly) {
  const SwerveKinematics kinematics{RobotGeometry{}};
  const Twist2 twist{0.6, 0.2, 0.4};
  WheelOdometry odometry;
  BaseState state;
  const WheelCommands commands = kinematics.inverse(twist, {0, 0, 0, 0}, 1e-6);
  const double dt = 0.05;
  const int steps = 100;
  for (int k = 0; k <= steps; ++k) {
    state.stamp = Stamp{fromSeconds(k * dt)};
    for (std::size_t i = 0; i < 4; ++i) {
      state.wheels[i].steer_rad = commands[i].steer_rad;
      state.wheels[i].drive_angle_rad = commands[i].drive_radps * k * dt;
    }
    odometry.update(kinematics, state);
  }
  // Constant twist for T = 5 s: yaw = 2 rad, position by the exact arc.
  const Pose2 expected = planarArc(0.6 * 5, 0.2 * 5, 0.4 * 5);
  EXPECT_NEAR(odometry.pose().x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(odometry.pose().y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(odometry.pose().yaw_rad, 2.0, 1e-9);
}

TEST(WheelOdometry, SkipsJumpsAndNaN) {
  const SwerveKinematics kinematics{RobotGeometry{}};
  WheelOdometry odometry;
  BaseState state;
  const auto feed = [&](double t, double angle) {
    state.stamp = Stamp{fromSeconds(t)};
    for (WheelState& wheel : state.wheels) wheel.drive_angle_rad = angle;
    odometry.update(kinematics, state);
  };
  feed(0.00, 0.0);
  feed(0.10, 1.0);  // 8.5 cm in 0.1 s
  feed(0.20, NAN);
  feed(0.30, 5000.0);  // a device restarted with another zero
  feed(0.40, 5001.0);  // and goes on
  EXPECT_NEAR(odometry.pose().x_m, 2 * 0.085, 1e-9);
  EXPECT_EQ(odometry.skipped(), 2);
}

TEST(PlanarArc, JoinsSmoothlyAtZeroYaw) {
  const Pose2 a = planarArc(1.0, 0.5, 0.9e-6);
  const Pose2 b = planarArc(1.0, 0.5, 1.1e-6);
  EXPECT_NEAR(a.x_m, b.x_m, 1e-6);
  EXPECT_NEAR(a.y_m, b.y_m, 1e-6);
}

}  // namespace
}  // namespace kiln
