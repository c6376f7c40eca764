#include "robot/app/state_history.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

using std::chrono::milliseconds;

Stamp at(int ms) { return Stamp{milliseconds(ms)}; }

RobotSample sample(int ms, double q0, double x, double yaw) {
  RobotSample s;
  s.stamp = at(ms);
  s.q[0] = q0;
  s.X_odom_base = {x, 0.0, yaw};
  return s;
}

TEST(StateHistory, InterpolatesJointsAndOdometryLinearly) {
  StateHistory history;
  history.add(sample(0, 0.0, 1.0, 0.0));
  history.add(sample(100, 1.0, 2.0, 0.2));
  const auto middle = history.at(at(25));
  ASSERT_TRUE(middle.has_value());
  EXPECT_DOUBLE_EQ(middle->q[0], 0.25);
  EXPECT_DOUBLE_EQ(middle->X_odom_base.x_m, 1.25);
  EXPECT_NEAR(middle->X_odom_base.yaw_rad, 0.05, 1e-12);
}

TEST(StateHistory, InterpolatesYawTheShortWayRound) {
  StateHistory history;
  history.add(sample(0, 0, 0, 3.1));
  history.add(sample(100, 0, 0, -3.1));
  // Half way from 3.1 to -3.1 through pi: both lie 0.0416 rad from it.
  EXPECT_NEAR(std::abs(history.at(at(50))->X_odom_base.yaw_rad), M_PI, 1e-9);
}

TEST(StateHistory, RefusesTimesOutsideButHoldsTheNewestForFiftyMilliseconds) {
  StateHistory history(milliseconds(200));
  EXPECT_FALSE(history.at(at(0)).has_value());
  for (int t = 0; t <= 500; t += 100) history.add(sample(t, t, 0, 0));
  EXPECT_FALSE(history.at(at(200)).has_value()) << "older than the span";
  EXPECT_EQ(history.at(at(540))->q[0], 500.0);
  EXPECT_FALSE(history.at(at(560)).has_value());
}

TEST(StateHistory, GoesOnAsItMovedForTenMilliseconds) {
  StateHistory history;
  for (int t = 0; t <= 80; t += 8) history.add(sample(t, 0.001 * t, 0.002 * t, 0));
  EXPECT_NEAR(history.at(at(86))->q[0], 0.086, 1e-12);
  EXPECT_NEAR(history.at(at(86))->X_odom_base.x_m, 0.172, 1e-12);
  EXPECT_NEAR(history.at(at(120))->q[0], 0.090, 1e-12) << "then it is held";
}

TEST(StateHistory, IgnoresSamplesThatAreNotNewer) {
  StateHistory history;
  history.add(sample(100, 1, 0, 0));
  history.add(sample(100, 2, 0, 0));
  history.add(sample(50, 3, 0, 0));
  EXPECT_EQ(history.newest()->q[0], 1.0);
}

}  // namespace
}  // namespace kiln
