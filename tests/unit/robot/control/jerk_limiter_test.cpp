#include "robot/control/jerk_limiter.h"

#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

using Limiter = JerkLimiter<3>;

TEST(JerkLimiter, ReachesATargetWithoutOvershootInTheTimeOfTheProfile) {
  Limiter limiter;
  const MotionLimits limits{0.8, 4.0};
  const double dt = 0.008;
  const Limiter::Vector target(1.0, 0, 0);
  double t = 0.0;
  while ((limiter.velocity() - target).norm() > 1e-9 && t < 5.0) {
    limiter.step(target, limits, dt);
    t += dt;
    ASSERT_LE(limiter.velocity()[0], 1.0 + 1e-9);
  }
  // Trapezoid of acceleration: v / a + a / j = 1.25 + 0.2 s.
  EXPECT_NEAR(t, 1.45, 0.03);
}

TEST(JerkLimiter, KeepsItsLimitsForRandomTargets) {
  Limiter limiter;
  const MotionLimits limits{0.8, 4.0};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Limiter::Vector target = Limiter::Vector::Zero();
  Limiter::Vector a_before = limiter.acceleration();
  for (int k = 0; k < 20000; ++k) {
    if (k % 7 == 0) target = Limiter::Vector(unit(random), unit(random), unit(random));
    limiter.step(target, limits, 0.008);
    ASSERT_LE(limiter.acceleration().norm(), limits.accel + 1e-9);
    ASSERT_LE((limiter.acceleration() - a_before).norm(), limits.jerk * 0.008 + 1e-9);
    a_before = limiter.acceleration();
  }
}

TEST(JerkLimiter, BrakesWithoutTurning) {
  Limiter limiter;
  limiter.reset({0.6, 0.3, -0.2});
  const Limiter::Vector direction = limiter.velocity().normalized();
  for (int k = 0; k < 200; ++k) {
    limiter.step(Limiter::Vector::Zero(), {2.0, 20.0}, 0.008);
    const Limiter::Vector v = limiter.velocity();
    ASSERT_NEAR((v - direction * direction.dot(v)).norm(), 0.0, 1e-9);
    ASSERT_GE(direction.dot(v), -1e-9);
  }
  EXPECT_EQ(limiter.velocity().norm(), 0.0);
}

/// A stop ramp that gives way to gentler limits: 1.8 m/s^2 taken back at 4 m/s^3 alone would end at
/// v - a^2 / (2 j) = -0.2 m/s.
TEST(JerkLimiter, GentlerLimitsDoNotCarryPastTheTarget) {
  for (const double target : {0.0, 0.3}) {
    for (int hard_steps = 1; hard_steps < 60; ++hard_steps) {
      JerkLimiter<1> limiter;
      limiter.reset(JerkLimiter<1>::Vector(0.3));
      for (int k = 0; k < hard_steps; ++k)
        limiter.step(JerkLimiter<1>::Vector(0.0), {1.8, 20.0}, 0.008);
      for (int k = 0; k < 400; ++k) {
        limiter.step(JerkLimiter<1>::Vector(target), {0.8, 4.0}, 0.008);
        ASSERT_GE(limiter.velocity()[0], -1e-9) << hard_steps << " steps, target " << target;
      }
      EXPECT_NEAR(limiter.velocity()[0], target, 1e-9);
    }
  }
}

TEST(JerkLimiter, FollowsARampWithItsFeedForward) {
  JerkLimiter<1> limiter;
  const double dt = 0.008, slope = 2.0;
  double worst = 0.0;
  for (int k = 1; k < 300; ++k) {
    const double t = k * dt;
    limiter.step(JerkLimiter<1>::Vector(slope * t), {4.0, 40.0}, dt, JerkLimiter<1>::Vector(slope));
    if (t > 0.5) worst = std::max(worst, std::abs(limiter.velocity()[0] - slope * t));
  }
  EXPECT_LT(worst, 1e-9);
}

}  // namespace
}  // namespace kiln
