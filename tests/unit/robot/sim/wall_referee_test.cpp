#include "robot/sim/wall_referee.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln::sim {
namespace {

Blueprint lab() {
  using enum BrickKind;
  return {{{Blue, Green, Green}, {Green, Blue, Red, Red}, {Red, Red, Green, Blue}}, false};
}

/// A wall as built, off the marker by `X_marker_wall`.
struct BuiltWall {
  explicit BuiltWall(const Blueprint& blueprint, const Pose2& X_marker_wall = {})
      : slots(wallSlots(blueprint)), X_map_marker(makePose({7, -1, 0.1}, {0, 0, 0.7})) {
    for (const WallSlot& slot : slots)
      bricks.push_back({slot.kind, X_map_marker * toIsometry(X_marker_wall) * slot.X_wall_brick});
  }
  void shift(std::size_t brick, double along_m, double turn_rad = 0.0, double up_m = 0.0) {
    bricks[brick].X_map_brick = bricks[brick].X_map_brick * Eigen::Translation3d(along_m, 0, up_m) *
                                Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ());
  }
  [[nodiscard]] WallScore score() const { return scoreWall(slots, bricks, X_map_marker); }

  std::vector<WallSlot> slots;
  Eigen::Isometry3d X_map_marker;
  std::vector<LyingBrick> bricks;
};

TEST(WallReferee, AWholeWallIsWorthAllItsPoints) {
  const WallScore score = BuiltWall(lab()).score();
  EXPECT_EQ(score.placed, 11U);
  EXPECT_DOUBLE_EQ(score.points, 4 * 1 + 4 * 2 + 3 * 3);
  EXPECT_LT(score.off_marker_m, 1e-9);
}

/// The frame is the wall's own; how far from the marker it stands is told apart.
TEST(WallReferee, AWallBesideItsMarkerCountsAndSaysSo) {
  const WallScore score = BuiltWall(lab(), {0.3, -0.2, 4.0 * kDeg}).score();
  EXPECT_EQ(score.placed, 11U);
  EXPECT_NEAR(score.off_marker_m, std::hypot(0.3, 0.2), 1e-6);
  EXPECT_NEAR(score.off_marker_rad, 4.0 * kDeg, 1e-6);
}

TEST(WallReferee, ABrickOffItsSlotDoesNotCount) {
  BuiltWall wall(lab());
  wall.shift(10, 0.06);             // a blue one of the upper layer
  wall.shift(5, 0.0, 6.0 * kDeg);   // a red one, turned
  wall.shift(4, 0.0, M_PI);         // turned by half a turn: the same brick
  wall.shift(3, 0.04, 3.0 * kDeg);  // within both limits
  const WallScore score = wall.score();
  EXPECT_EQ(score.placed, 9U);
  EXPECT_DOUBLE_EQ(score.points, 21 - 3 - 1);
  EXPECT_FALSE(score.brick_in_slot[10].has_value());
  EXPECT_EQ(score.brick_in_slot[3], 3U);
}

TEST(WallReferee, WhatLeansOrLiesInThePileDoesNotCount) {
  BuiltWall wall(lab());
  wall.bricks[2].X_map_brick.rotate(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()));
  for (std::size_t i = 3; i < wall.bricks.size(); ++i)
    wall.bricks[i].X_map_brick.pretranslate(Eigen::Vector3d(-6, 3, 0));
  EXPECT_EQ(wall.score().placed, 2U);
  const WallScore nothing = scoreWall(wall.slots, {}, wall.X_map_marker);
  EXPECT_EQ(nothing.placed, 0U);
  EXPECT_FALSE(nothing.X_map_wall.has_value());
}

TEST(WallReferee, TheFullTaskIsWorthNinetyFivePoints) {
  using enum BrickKind;
  Blueprint full;
  full.layers.assign(5, {Red, Green, Blue, Red, Green, Red, Red});
  const WallScore score = BuiltWall(full, {0.1, 0.1, -0.05}).score();
  EXPECT_EQ(score.placed, 45U);
  EXPECT_DOUBLE_EQ(score.points, 20 * 1 + 10 * 2 + 5 * 3 + 10 * 4);
}

}  // namespace
}  // namespace kiln::sim
