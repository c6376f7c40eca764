#include "robot/missions/wall/skills/view_planner.h"

#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "robot/scene/pile_layout.h"

namespace kiln {
namespace {

constexpr double kAcross = M_PI_2;  // of a brick that lies across the view

class ViewPlannerTest : public ::testing::Test {
 protected:
  /// The lab's pile 2.2 m before the arm's mount, its front line across the view.
  static ExpectedBricks labBricks() {
    ExpectedBricks out;
    for (const PileSlot& slot : labPile().slots())
      out.target.bricks.push_back(
          {static_cast<int>(out.target.bricks.size()), slot.kind, slot.X_pile_brick, false});
    out.target.X_base_target =
        makePose({2.8, 0.5 * labPile().length(), 0}, {0, 0, -M_PI_2});  // Y away from the robot
    return out;
  }
  /// A screen of five green bricks, 1 m high; behind it to the left and to the right a red one. The
  /// screen itself is of no interest.
  static ExpectedBricks hiddenBricks() {
    ExpectedBricks out;
    for (int layer = 0; layer < 5; ++layer)
      out.target.bricks.push_back(
          {layer, BrickKind::Green, makePose({2.0, 0, 0.1 + 0.2 * layer}, {0, 0, kAcross}), true});
    out.target.bricks.push_back(
        {kLeft, BrickKind::Red, makePose({3.0, 0.25, 0.1}, {0, 0, 0}), false});
    out.target.bricks.push_back(
        {kRight, BrickKind::Red, makePose({3.0, -0.25, 0.1}, {0, 0, 0}), false});
    return out;
  }
  static ViewPlanner::Config sidewards() {
    ViewPlanner::Config config;
    config.ahead_m = {0.55};
    config.up_m = {0.9};
    config.aside_m = {0.0, 0.7, -0.7};
    return config;
  }
  [[nodiscard]] ViewPlanner::Reach byArm(const ViewPlanner& planner) const {
    return planner.reachOf(world, RobotGeometry::radians(robot.q_drive_deg));
  }
  static constexpr int kLeft = 5, kRight = 6;
  RobotGeometry robot = *loadResource<RobotGeometry>("robot_model/mario.yaml");
  ArmCollision world{robot};
};

TEST_F(ViewPlannerTest, OneSweepShowsTheLabsPile) {
  const ViewPlanner planner({}, robot);
  const auto plan = planner.plan(labBricks(), byArm(planner));
  ASSERT_TRUE(plan.has_value()) << plan.error();
  ASSERT_EQ(plan->views.size(), 1U) << plan->why;
  EXPECT_TRUE(plan->uncovered.empty());
  ASSERT_EQ(plan->cells.size(), 11U);
  for (const double cells : plan->cells) EXPECT_GT(cells, planner.neededCells());
  // From 1 m of height down to the ground, from above: no wider than that.
  EXPECT_LT(plan->views[0].view.span() / kDeg, 40.0);
  EXPECT_GT(plan->views[0].view.span() / kDeg, 15.0);
}

TEST_F(ViewPlannerTest, ABrickBehindAnotherNeedsASecondView) {
  const ViewPlanner planner(sidewards(), robot);
  const ExpectedBricks bricks = hiddenBricks();
  const auto plan = planner.plan(bricks, byArm(planner));
  ASSERT_TRUE(plan.has_value()) << plan.error();
  ASSERT_EQ(plan->views.size(), 2U) << plan->why;
  EXPECT_TRUE(plan->uncovered.empty());
  // One from either side, each for its own brick.
  EXPECT_LT(plan->views[0].view.p_base.y() * plan->views[1].view.p_base.y(), -0.2);
  for (const PlannedView& view : plan->views) {
    const bool left = view.view.p_base.y() > 0.0;
    EXPECT_GT(view.cells[left ? kLeft : kRight], planner.neededCells());
    EXPECT_LT(view.cells[left ? kRight : kLeft], planner.neededCells());
  }
  ViewPlanner::Config one = sidewards();
  one.max_views = 1;
  const ViewPlanner single(one, robot);
  const auto less = single.plan(bricks, byArm(single));
  ASSERT_TRUE(less.has_value());
  EXPECT_EQ(less->uncovered.size(), 1U);
}

TEST_F(ViewPlannerTest, TakesFewerViewsThanAFixedFan) {
  const ViewPlanner planner(sidewards(), robot);
  const ExpectedBricks bricks = hiddenBricks();
  const auto plan = planner.plan(bricks, byArm(planner));
  ASSERT_TRUE(plan.has_value());
  std::vector<LidarView> fixed;
  for (const double aside : {0.0, 0.7, -0.7})
    fixed.push_back({{0.89, aside, 1.52}, 0.0, 2.0 * kDeg, 40.0 * kDeg});
  EXPECT_TRUE(planner.assess(bricks, fixed).uncovered.empty());
  fixed.pop_back();
  EXPECT_EQ(planner.assess(bricks, fixed).uncovered.size(), 1U);
  fixed.pop_back();
  EXPECT_EQ(planner.assess(bricks, fixed).uncovered.size(), 2U) << "the middle sees neither";
  EXPECT_TRUE(plan->uncovered.empty());
  EXPECT_LT(plan->views.size(), 3U);
}

TEST_F(ViewPlannerTest, LeavesOutWhatTheArmCannotReach) {
  const ViewPlanner planner({}, robot);
  const auto none = planner.plan(labBricks(), [](const LidarView&) -> Result<SweepMotion> {
    return makeError(ErrorCode::Refused, "too near: forearm to deck");
  });
  ASSERT_TRUE(none.has_value());
  EXPECT_TRUE(none->views.empty());
  EXPECT_EQ(none->uncovered.size(), 11U);
  EXPECT_EQ(none->unreachable, none->considered);
  EXPECT_EQ(none->why, "too near: forearm to deck");
  // What was best at first is not to be had: the next best shows as many bricks.
  std::optional<LidarView> best;
  const ViewPlanner::Reach arm = byArm(planner);
  const auto second = planner.plan(labBricks(), [&](const LidarView& view) -> Result<SweepMotion> {
    if (!best) best = view;
    if (view.p_base.isApprox(best->p_base)) return makeError(ErrorCode::Refused, "no");
    return arm(view);
  });
  ASSERT_TRUE(second.has_value());
  ASSERT_EQ(second->views.size(), 1U);
  EXPECT_FALSE(second->views[0].view.p_base.isApprox(best->p_base));
  EXPECT_TRUE(second->uncovered.empty());
  EXPECT_GE(second->unreachable, 1);
}

TEST_F(ViewPlannerTest, WhatIsUncertainIsSpannedWiderAndExpectedLess) {
  const ViewPlanner planner({}, robot);
  ExpectedBricks sure = labBricks(), unsure = labBricks();
  unsure.covariance = Eigen::Vector3d(0.3, 0.3, 8.0 * kDeg).cwiseAbs2().asDiagonal();
  EXPECT_GT(planner.fan(unsure)[0].span(), planner.fan(sure)[0].span() + 2.0 * kDeg);
  const auto plan = planner.plan(unsure, byArm(planner)),
             again = planner.plan(unsure, byArm(planner));
  ASSERT_TRUE(plan.has_value() && again.has_value());
  EXPECT_TRUE(plan->uncovered.empty());
  ASSERT_EQ(plan->views.size(), again->views.size());
  for (std::size_t i = 0; i < plan->views.size(); ++i)
    EXPECT_EQ(plan->views[i].motion.q_from, again->views[i].motion.q_from);
  EXPECT_EQ(plan->cells, again->cells);
}

TEST_F(ViewPlannerTest, SaysWhatIsWrongWithTheQuestion) {
  const ViewPlanner planner({}, robot);
  ExpectedBricks none = labBricks();
  for (TargetBrick& brick : none.target.bricks) brick.excluded = true;
  EXPECT_EQ(planner.plan(none, byArm(planner)).error().code, ErrorCode::InvalidInput);
  ExpectedBricks broken = labBricks();
  broken.target.X_base_target.translation().x() = NAN;
  EXPECT_EQ(planner.plan(broken, byArm(planner)).error().code, ErrorCode::InvalidInput);
}

TEST_F(ViewPlannerTest, TheFirstLookNeedsNoTarget) {
  const ViewPlanner planner({}, robot);
  const auto look = planner.firstLook(byArm(planner));
  ASSERT_TRUE(look.has_value()) << look.error();
  const auto poses = lidarPoses(robot, *look, 3);
  EXPECT_NEAR(std::asin(poses.front().linear()(2, 0)) / kDeg, 4.0, 0.1);   // up
  EXPECT_NEAR(std::asin(poses.back().linear()(2, 0)) / kDeg, -16.0, 0.1);  // down
}

}  // namespace
}  // namespace kiln
