#include "robot/planning/arm_motion/arm_planner.h"

#include <cmath>

#include "robot/planning/arm_motion/ur_inverse.h"
#include "tests/unit/robot/planning/arm_motion/bob.h"

namespace kiln {
namespace {

class ArmPlannerTest : public ::testing::Test {
 protected:
  ArmPlanner::Progress solve(ArmPlanner& planner, const Vector6d& goal) {
    ArmPlanner::Progress progress = planner.start(home, {goal});
    while (progress == ArmPlanner::Progress::Running) progress = planner.advance(100);
    return progress;
  }
  void expectFree(const std::vector<Vector6d>& path) {
    for (std::size_t k = 1; k < path.size(); ++k) {
      for (int n = 0; n <= 200; ++n) {
        const Vector6d q = path[k - 1] + (path[k] - path[k - 1]) * (n / 200.0);
        ASSERT_GT(collision.distance(q), 0.03 - 0.005);
      }
    }
  }
  /// A post on the deck beside the head, higher than it.
  void putPost() {
    BoxConfig post;
    post.name = "post";
    post.center.xyz_m = {0.95, -0.35, 0.95};
    post.size_m = {0.1, 0.1, 0.7};
    collision.setScene({post}, Pose2{});
  }

  RobotGeometry robot = loadBob();
  ArmCollision collision{robot};
  Vector6d home = RobotGeometry::radians(robot.q_drive_deg);
};

TEST_F(ArmPlannerTest, TakesTheStraightMoveWhereItIsFree) {
  ArmPlanner planner({}, robot, collision);
  const Vector6d park = RobotGeometry::radians(robot.q_park_deg);
  EXPECT_EQ(planner.start(home, {park}), ArmPlanner::Progress::Found);
  EXPECT_EQ(planner.path().size(), 2u);
}

TEST_F(ArmPlannerTest, FindsAWayAroundAPostAndTheSameOneAgain) {
  putPost();
  Vector6d goal = home;
  goal[0] -= 1.9;  // swings the head through the post
  ASSERT_FALSE(collision.pathIsFree(home, goal, 0.03));
  ASSERT_GT(collision.distance(goal), 0.03) << collision.clearance(goal).what;
  ArmPlanner planner({}, robot, collision);
  ASSERT_EQ(solve(planner, goal), ArmPlanner::Progress::Found);
  ASSERT_GT(planner.path().size(), 2u);
  EXPECT_EQ((planner.path().front() - home).norm(), 0.0);
  EXPECT_EQ((planner.path().back() - goal).norm(), 0.0);
  expectFree(planner.path());
  ArmPlanner again({}, robot, collision);
  ASSERT_EQ(solve(again, goal), ArmPlanner::Progress::Found);
  ASSERT_EQ(again.path().size(), planner.path().size());
  for (std::size_t k = 0; k < again.path().size(); ++k) {
    EXPECT_EQ((again.path()[k] - planner.path()[k]).norm(), 0.0);
  }
}

TEST_F(ArmPlannerTest, GivesUpAfterItsIterations) {
  putPost();
  Vector6d goal = home;
  goal[0] -= 1.9;
  ArmPlanner::Config config;
  config.max_iterations = 2;
  ArmPlanner planner(config, robot, collision);
  EXPECT_EQ(solve(planner, goal), ArmPlanner::Progress::Failed);
}

TEST_F(ArmPlannerTest, DoesNotStartFromATouchingPosture) {
  BoxConfig box;
  const Eigen::Vector3d p = robot.X_base_flange(home).translation();
  box.center.xyz_m = {p.x(), p.y(), p.z()};
  box.size_m = {0.1, 0.1, 0.1};
  collision.setScene({box}, Pose2{});
  ArmPlanner planner({}, robot, collision);
  EXPECT_EQ(planner.start(home, {RobotGeometry::radians(robot.q_park_deg)}),
            ArmPlanner::Progress::Failed);
}

/// A load that must not be tilted: the way around the post keeps the flange's tilt.
TEST_F(ArmPlannerTest, KeepsTheTiltAllTheWayWhenAsked) {
  putPost();
  Vector6d goal = home;
  goal[0] -= 1.9;
  ArmPlanner planner({}, robot, collision);
  const ArmPathDemand demand{std::nullopt, true};
  ArmPlanner::Progress progress = planner.start(home, {goal}, demand);
  while (progress == ArmPlanner::Progress::Running) progress = planner.advance(100);
  ASSERT_EQ(progress, ArmPlanner::Progress::Found);
  ASSERT_GT(planner.path().size(), 2u);
  expectFree(planner.path());
  const Eigen::Vector3d up = robot.X_base_flange(home).linear().row(2);
  for (std::size_t k = 1; k < planner.path().size(); ++k) {
    for (int n = 0; n <= 20; ++n) {
      const Vector6d q =
          planner.path()[k - 1] + (planner.path()[k] - planner.path()[k - 1]) * (n / 20.0);
      const Eigen::Vector3d now = robot.X_base_flange(q).linear().row(2);
      EXPECT_LT((now - up).norm(), 1e-6);
    }
  }
}

TEST_F(ArmPlannerTest, AGoalOfAnotherTiltIsNoGoalThen) {
  Vector6d goal = home;
  goal[5] += 0.5;
  ArmPlanner planner({}, robot, collision);
  EXPECT_EQ(planner.start(home, {goal}), ArmPlanner::Progress::Found);
  EXPECT_EQ(planner.start(home, {goal}, {std::nullopt, true}), ArmPlanner::Progress::Failed);
}

}  // namespace
}  // namespace kiln
