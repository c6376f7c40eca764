#include "robot/app/state_history.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

using std::chrono::milliseconds;

Stamp at(int ms) { return Stamp{milliseconds(ms)}; }

void add(StateHistory& history, int ms, double q0, double x, double yaw) {
  Vector6d q = Vector6d::Zero();
  q[0] = q0;
  history.addJoints(at(ms), q);
  history.addOdometry(at(ms), {x, 0.0, yaw});
}

TEST(StateHistory, InterpolatesJointsAndOdometryLinearly) {
  StateHistory history;
  add(history, 0, 0.0, 1.0, 0.0);
  add(history, 100, 1.0, 2.0, 0.2);
  const auto middle = history.at(at(25));
  ASSERT_TRUE(middle.has_value());
  EXPECT_DOUBLE_EQ(middle->q[0], 0.25);
  EXPECT_DOUBLE_EQ(middle->X_odom_base.x_m, 1.25);
  EXPECT_NEAR(middle->X_odom_base.yaw_rad, 0.05, 1e-12);
}

TEST(StateHistory, InterpolatesYawTheShortWayRound) {
  StateHistory history;
  add(history, 0, 0, 0, 3.1);
  add(history, 100, 0, 0, -3.1);
  // Half way from 3.1 to -3.1 through pi: both lie 0.0416 rad from it.
  EXPECT_NEAR(std::abs(history.at(at(50))->X_odom_base.yaw_rad), M_PI, 1e-9);
}

TEST(StateHistory, RefusesTimesOutsideButHoldsTheNewestForFiftyMilliseconds) {
  StateHistory history(milliseconds(200));
  EXPECT_FALSE(history.at(at(0)).has_value());
  for (int t = 0; t <= 500; t += 100) add(history, t, t, 0, 0);
  EXPECT_FALSE(history.at(at(200)).has_value()) << "older than the span";
  EXPECT_EQ(history.at(at(540))->q[0], 500.0);
  EXPECT_FALSE(history.at(at(560)).has_value());
}

TEST(StateHistory, GoesOnAsItMovedForTenMilliseconds) {
  StateHistory history;
  for (int t = 0; t <= 80; t += 8) add(history, t, 0.001 * t, 0.002 * t, 0);
  EXPECT_NEAR(history.at(at(86))->q[0], 0.086, 1e-12);
  EXPECT_NEAR(history.at(at(86))->X_odom_base.x_m, 0.172, 1e-12);
  EXPECT_NEAR(history.at(at(120))->q[0], 0.090, 1e-12) << "then it is held";
}

/// Joints move 1 rad/s and are reported 5 ms after the wheels, which roll 1 m/s.
TEST(StateHistory, ArmAndWheelsAreInterpolatedEachByItsOwnStamps) {
  StateHistory history;
  for (int t = 0; t <= 80; t += 8) {
    history.addOdometry(at(t), {0.001 * t, 0, 0});
    Vector6d q = Vector6d::Zero();
    q[0] = 0.001 * (t + 5);
    history.addJoints(at(t + 5), q);
  }
  for (int t = 5; t <= 80; ++t) {
    const auto both = history.at(at(t));
    ASSERT_TRUE(both.has_value()) << t;
    EXPECT_NEAR(both->q[0], 0.001 * t, 1e-12) << t;
    EXPECT_NEAR(both->X_odom_base.x_m, 0.001 * t, 1e-12) << t;
  }
  EXPECT_FALSE(history.at(at(2)).has_value()) << "no joints yet";
}

TEST(StateHistory, IgnoresSamplesThatAreNotNewer) {
  StateHistory history;
  add(history, 100, 1, 0, 0);
  add(history, 100, 2, 0, 0);
  add(history, 50, 3, 0, 0);
  EXPECT_EQ(history.at(at(100))->q[0], 1.0);
}

}  // namespace
}  // namespace kiln
