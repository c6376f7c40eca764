#include "robot/planning/base_path/corridor.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

constexpr double kLength = 1.9, kWidth = 1.4;

BasePath straight(double to_x = 6.0) { return {{0, 0, 0}, {{to_x, 0, 0}}, {}}; }

/// A post of 12 points, 10 cm thick.
std::vector<Eigen::Vector2d> post(double x, double y) {
  std::vector<Eigen::Vector2d> out;
  for (int i = 0; i < 12; ++i)
    out.emplace_back(x + 0.05 * std::cos(0.52 * i), y + 0.05 * std::sin(0.52 * i));
  return out;
}

std::optional<CorridorHit> look(const std::vector<Eigen::Vector2d>& points, double from_s = 0.0,
                                const Pose2& here = {0, 0, 0}) {
  return firstInCorridor(straight(), from_s, here, kLength, kWidth, points, {});
}

TEST(Corridor, TellsTheWayThatIsLeft) {
  const auto hit = look(post(2.0, 0.3));
  ASSERT_TRUE(hit.has_value());
  // Front edge 0.95 m ahead of the base, margin 0.06 m, near side of the post at 1.95 m.
  EXPECT_NEAR(hit->distance_m, 2.0 - 0.05 - 0.95 - 0.06, 0.12);
  EXPECT_NEAR(hit->p_map.x(), 2.0, 0.08);
  EXPECT_GE(hit->points, 4);
}

TEST(Corridor, IsFreeBesideBehindAndBeyondThePieceThatLiesAhead) {
  EXPECT_FALSE(look({}).has_value());
  EXPECT_FALSE(look(post(2.0, 0.9)).has_value()) << "beside: half width 0.7 + 0.06";
  EXPECT_FALSE(look(post(-1.5, 0.0)).has_value()) << "behind";
  EXPECT_FALSE(look(post(4.5, 0.0)).has_value()) << "farther than 2 m ahead";
  EXPECT_TRUE(look(post(4.5, 0.0), 2.0, {2, 0, 0}).has_value()) << "nearer later";
  const auto after_the_end =
      firstInCorridor(straight(1.0), 0.0, {0, 0, 0}, kLength, kWidth, post(2.3, 0.0), {});
  EXPECT_FALSE(after_the_end.has_value()) << "the path ends before it";
}

TEST(Corridor, AFewStrayPointsAndTheRobotItselfAreNoObstacle) {
  EXPECT_FALSE(look({{2.0, 0.0}, {2.0, 0.1}, {1.9, 0.0}}).has_value()) << "three points";
  EXPECT_FALSE(look({{1.5, 0.6}, {2.0, -0.6}, {2.5, 0.6}, {2.9, -0.5}}).has_value()) << "scattered";
  EXPECT_FALSE(look(post(0.4, 0.2)).has_value()) << "within the footprint";
  EXPECT_FALSE(look({{NAN, 0}, {2, NAN}}).has_value());
}

TEST(Corridor, WhatStandsBesideTheRobotMayStayThereButNotComeNearer) {
  std::vector<Eigen::Vector2d> wall;
  for (double x = -0.9; x < 0.9; x += 0.05) wall.emplace_back(x, 0.73);  // 3 cm beside the robot
  EXPECT_FALSE(look(wall).has_value());
  const BasePath towards{{0, 0, 0}, {{2.0, 0.3, 0}}, {}};
  EXPECT_TRUE(firstInCorridor(towards, 0.0, {0, 0, 0}, kLength, kWidth, wall, {}).has_value());
}

}  // namespace
}  // namespace kiln
