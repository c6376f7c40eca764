#include "robot/missions/common/route.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/kitchen.h"

namespace kiln {
namespace {

constexpr double kRadius_m =
    1.18 + 0.35;  // circumscribed circle of 1.9 x 1.4 m and the configured clearance

class RouteTest : public testing::Test {
 protected:
  const ArenaMap arena = loadKitchen();
};

TEST_F(RouteTest, WallsFurnitureAndTablesBlockALine) {
  EXPECT_TRUE(straightIsClear(arena, {7.4, 0, 0}, {9.6, -0.6, 0}, kRadius_m));
  EXPECT_FALSE(straightIsClear(arena, {0, 3, 0}, {8, 3, 0}, kRadius_m)) << "through the west wall";
  EXPECT_FALSE(straightIsClear(arena, {9.95, 2.8, 0}, {12.1, 2.8, 0}, kRadius_m))
      << "onto the table of place 1";
  EXPECT_TRUE(straightIsClear(arena, {4.9, 0, 0}, {5.1, 0, 0}, 1.2))
      << "the lintel is driven under";
}

TEST_F(RouteTest, AWayPointIsKeptWhereTheStraightLineIsBlocked) {
  // Around the west wall: the straight line from outside to a point behind the wall is blocked, by
  // way of the door not.
  const std::vector<Pose2> route{{2.5, 0, 0}, {7.4, 0, 0}, {7.4, 3.0, 0}};
  const auto kept = shortened(arena, {2.5, 3.0, 0}, route, 1.2);
  ASSERT_EQ(kept.size(), 3u);
}

TEST(Remaining, StartsAtTheSegmentWhereTheRobotStands) {
  const std::vector<Pose2> route{{2.5, 0, 0}, {7.4, 0, 0}};
  EXPECT_EQ(remaining({0, 0, 0}, route, {0.1, 0.1, 0}).size(), 2u);
  EXPECT_EQ(remaining({0, 0, 0}, route, {4.0, 0.2, 0}).size(), 1u) << "half-way to the hub";
  EXPECT_EQ(remaining({0, 0, 0}, route, {9.0, 1.0, 0}).size(), 1u)
      << "beyond it the hub is still the goal";
  EXPECT_TRUE(remaining({0, 0, 0}, {}, {1, 1, 0}).empty());
}

class RunUpTest : public testing::Test {
 protected:
  /// With a front (+) or rear (-) wheel's centre so far before the edge.
  [[nodiscard]] Pose2 before(double metres, double front = 1.0) const {
    return {approach.edge_x_m - metres - front * robot.wheel_x_m, 0.2, 0.0};
  }
  ApproachConfig approach{1.0, 3.2, 4.0, 3.6, 0.02};
  RobotGeometry robot = [] {
    RobotGeometry bob;
    bob.wheel_x_m = 0.7;
    bob.wheel_y_m = 0.58;
    return bob;
  }();
  const Pose2 inside{7.4, 0, 0};
};

TEST_F(RunUpTest, FrontAndRearWheelsAtTheEdgeBackUp) {
  for (const double front : {1.0, -1.0}) {
    for (const double metres : {0.25, 0.055, 0.0}) {
      const auto back = runUp(approach, robot, before(metres, front), inside);
      ASSERT_TRUE(back.has_value()) << metres;
      EXPECT_NEAR(back->x_m, before(0.6, front).x_m, 1e-9);
      EXPECT_EQ(back->y_m, 0.2);
      EXPECT_EQ(back->yaw_rad, 0.0);
    }
  }
}

TEST_F(RunUpTest, NobodyBacksUpWithoutNeed) {
  EXPECT_FALSE(runUp(approach, robot, before(0.4), inside)) << "has room enough";
  EXPECT_FALSE(runUp(approach, robot, before(-0.1), inside)) << "over it";
  EXPECT_FALSE(runUp(approach, robot, before(0.1), {0, 0, 0})) << "the way leads down";
  EXPECT_FALSE(runUp(approach, robot, before(0.1), before(0.08))) << "stays before the edge";
  EXPECT_FALSE(runUp({}, robot, before(0.1), inside)) << "flat ground";
}

TEST_F(RunUpTest, ARobotThatStandsAskewBacksUpAlongTheApproach) {
  Pose2 here = before(0.1);
  here.yaw_rad = 0.2;  // its right front wheel is 0.1 m further on, the left one behind
  const auto back = runUp(approach, robot, here, inside);
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR((*back * Pose2{0.7, -0.58, 0}).x_m, approach.edge_x_m - 0.6, 1e-9);
}

}  // namespace
}  // namespace kiln
