#include "robot/safety/geofence.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

constexpr double kLength = 1.9, kWidth = 1.4;

/// 10 m x 6 m with a notch of 2 m x 2 m in its upper right corner.
std::vector<Eigen::Vector2d> notched() {
  return {{0, 0}, {10, 0}, {10, 4}, {8, 4}, {8, 6}, {0, 6}};
}

Geofence fence() { return *Geofence::create({}, notched(), kLength, kWidth); }

TEST(Geofence, RefusesWhatIsNoPolygon) {
  EXPECT_EQ(Geofence::create({}, {{0, 0}, {1, 0}}, 1, 1).error().code, ErrorCode::InvalidInput);
  EXPECT_EQ(Geofence::create({}, {{0, 0}, {NAN, 0}, {1, 1}}, 1, 1).error().code,
            ErrorCode::InvalidInput);
  const auto bow_tie = Geofence::create({}, {{0, 0}, {4, 4}, {4, 0}, {0, 4}}, 1, 1);
  ASSERT_FALSE(bow_tie.has_value());
  EXPECT_NE(bow_tie.error().message.find("crosses itself"), std::string::npos);
}

TEST(Geofence, RoomIsThatOfTheGrownFootprint) {
  // Half length 0.95 + margin 0.1 from x = 3 to the border at 0.
  EXPECT_NEAR(fence().room({3, 3, 0}), 3 - 1.05, 1e-9);
  EXPECT_NEAR(fence().room({3, 1.5, 0}), 1.5 - 0.8, 1e-9);
  EXPECT_LT(fence().room({0.5, 3, 0}), 0.0);
  EXPECT_LT(fence().room({9, 5, 0}), 0.0) << "in the notch";
  // Turned by a quarter the long side points to the near border.
  EXPECT_NEAR(fence().room({3, 1.5, M_PI / 2}), 1.5 - 1.05, 1e-9);
}

TEST(Geofence, WhateverIsCommandedTheRobotStaysInsideAndAllMotionInsideIsLeftAlone) {
  // A base that follows 0.15 s late and brakes with 0.8 m/s^2, driven by a careless hand.
  const Geofence border = fence();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int run = 0; run < 40; ++run) {
    Pose2 at{4 + 2 * unit(random), 3 + 0.5 * unit(random), M_PI * unit(random)};
    const Twist2 wish{unit(random), unit(random), 0.6 * unit(random)};
    Twist2 moving;
    std::vector<Twist2> late(15);
    constexpr double kDt = 0.01, kAccel = 0.8;
    for (int i = 0; i < 1500; ++i) {
      late.push_back(border.limit(wish, at).twist);
      const Twist2 target = late[late.size() - 15];
      const auto follow = [](double now, double to) {
        return now + std::clamp(to - now, -kAccel * kDt, kAccel * kDt);
      };
      moving = {follow(moving.vx_mps, target.vx_mps), follow(moving.vy_mps, target.vy_mps),
                follow(moving.wz_radps, target.wz_radps)};
      at = at * Pose2{moving.vx_mps * kDt, moving.vy_mps * kDt, moving.wz_radps * kDt};
      ASSERT_GT(border.room(at), -0.1)
          << "the margin of 10 cm is there for what is left, run " << run;
    }
  }
  const Geofence::Limited free = border.limit({1, 0, 0}, {4, 3, 0});
  EXPECT_FALSE(free.limited);
  EXPECT_EQ(free.twist.vx_mps, 1.0);
}

TEST(Geofence, SaysWhyAndLetsARobotOutsideOnlyBackIn) {
  const Geofence border = fence();
  const Geofence::Limited ahead = border.limit({1, 0, 0}, {8.7, 2, 0});
  EXPECT_TRUE(ahead.limited);
  EXPECT_LT(ahead.twist.vx_mps, 0.5);
  EXPECT_NE(ahead.reason.find("geofence: the border is 0.25 m away"), std::string::npos)
      << ahead.reason;
  const Pose2 outside{9.3, 2, 0};
  EXPECT_EQ(border.limit({0.3, 0, 0}, outside).twist.vx_mps, 0.0);
  EXPECT_EQ(border.limit({-0.3, 0, 0}, outside).twist.vx_mps, -0.3);
  EXPECT_EQ(border.limit({1, 0, 0}, {NAN, 0, 0}).twist.vx_mps, 0.0);
}

}  // namespace
}  // namespace kiln
