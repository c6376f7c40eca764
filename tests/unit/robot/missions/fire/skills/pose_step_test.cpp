#include "robot/missions/fire/skills/pose_step.h"

#include <cmath>

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(PoseStep, ArrivesInStepsOfBoundedLengthAndTurn) {
  const Eigen::Isometry3d X_goal = makePose({0.37, -0.2, 0.1}, {0.1, 0.4, -0.6});
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  int steps = 0;
  while (!atPose(X, X_goal, 1e-9, 1e-6) && steps < 100) {
    const Eigen::Isometry3d X_next = poseStep(X, X_goal, 0.10, 0.2);
    EXPECT_LE((X_next.translation() - X.translation()).norm(), 0.10 + 1e-9);
    EXPECT_LE(rotationAngle(X.inverse() * X_next), 0.2 + 1e-6);
    X = X_next;
    ++steps;
  }
  EXPECT_EQ(steps, 5) << "0.43 m in steps of 10 cm; the turn of 0.7 rad in steps of 0.2 needs 4";
}

TEST(PoseStep, IsTheGoalWhenNear) {
  const Eigen::Isometry3d X_goal = makePose({0.05, 0, 0}, {0, 0, 0.05});
  EXPECT_TRUE(poseStep(Eigen::Isometry3d::Identity(), X_goal, 0.1, 0.1).isApprox(X_goal));
}

TEST(PoseStep, AtPoseJudgesPositionAndTurn) {
  const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  EXPECT_TRUE(atPose(X, makePose({0.009, 0, 0}, {0, 0, 0}), 0.01, 0.02));
  EXPECT_FALSE(atPose(X, makePose({0.011, 0, 0}, {0, 0, 0}), 0.01, 0.02));
  EXPECT_FALSE(atPose(X, makePose({0, 0, 0}, {0, 0, 0.021}), 0.01, 0.02));
}

}  // namespace
}  // namespace kiln
