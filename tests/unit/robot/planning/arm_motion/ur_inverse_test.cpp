#include "robot/planning/arm_motion/ur_inverse.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

class RandomJoints {
 public:
  Vector6d operator()() {
    Vector6d q;
    for (int i = 0; i < 6; ++i) q[i] = M_PI * unit_(random_);
    return q;
  }

 private:
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

/// Near these the position of a joint follows from a square root of rounding errors.
bool nearSingular(const UrKinematics& arm, const Vector6d& q) {
  const auto X = arm.frames(q);
  const double rho = X[4].translation().head<2>().norm();
  return std::abs(std::sin(q[4])) < 1e-3 || std::abs(std::sin(q[2])) < 1e-3 ||
         rho - arm.d[3] < 1e-3;
}

double poseError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

TEST(UrInverse, EverySolutionOf5000RandomPosesMeetsThePose) {
  const UrKinematics arm = UrKinematics::ur10e();
  RandomJoints random;
  for (int k = 0; k < 5000; ++k) {
    const Vector6d q = random();
    if (nearSingular(arm, q)) continue;
    const Eigen::Isometry3d X = arm.forward(q);
    const auto solutions = inverseSolutions(arm, X);
    ASSERT_GE(solutions.size(), 2u);
    ASSERT_LE(solutions.size(), 8u);
    double nearest = INFINITY;
    for (const Vector6d& solution : solutions) {
      ASSERT_LT(poseError(arm.forward(solution), X), 1e-9);
      ASSERT_LE(solution.cwiseAbs().maxCoeff(), M_PI + 1e-12);
      nearest = std::min(nearest, (solution - q).cwiseAbs().maxCoeff());
    }
    ASSERT_LT(nearest, 1e-7) << "the posture that made the pose is among its solutions";
  }
}

TEST(UrInverse, FindsAllEightOfACommonPose) {
  const UrKinematics arm = UrKinematics::ur10e();
  Vector6d q;
  q << 0.2, -1.6, 1.9, -0.4, 1.4, 0.3;
  const auto solutions = inverseSolutions(arm, arm.forward(q));
  ASSERT_EQ(solutions.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = i + 1; j < 8; ++j) {
      EXPECT_GT((solutions[i] - solutions[j]).cwiseAbs().maxCoeff(), 1e-3);
    }
  }
}

TEST(UrInverse, AtTheWristSingularityJoint6ComesFromTheReference) {
  const UrKinematics arm = UrKinematics::ur10e();
  Vector6d q;
  q << 0.2, -1.6, 1.9, -0.4, 0.0, 0.7;
  const auto solutions = inverseSolutions(arm, arm.forward(q), q);
  ASSERT_FALSE(solutions.empty());
  double nearest = INFINITY;
  for (const Vector6d& solution : solutions) {
    EXPECT_LT(poseError(arm.forward(solution), arm.forward(q)), 1e-6);
    nearest = std::min(nearest, (solution - q).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(nearest, 1e-6);
}

TEST(UrInverse, NothingOutOfReach) {
  const UrKinematics arm = UrKinematics::ur10e();
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(2.0, 0, 0.5);
  EXPECT_TRUE(inverseSolutions(arm, X).empty());
  X.translation() = Eigen::Vector3d(0.0, 0.0, 0.3);  // wrist centre inside the shoulder's cylinder
  EXPECT_TRUE(inverseSolutions(arm, X).empty());
}

TEST(UrInverse, TurnsStayWithinLimitsAndNearTheReference) {
  const UrKinematics arm = UrKinematics::ur10e();
  RandomJoints random;
  for (int k = 0; k < 500; ++k) {
    const Vector6d q = random();
    const Vector6d reference = 2.0 * random();
    const Vector6d near = nearestTurn(arm, q, reference);
    ASSERT_TRUE(withinLimits(arm, near));
    ASSERT_LT(poseError(arm.forward(near), arm.forward(q)), 1e-9);
    const auto variants = turnVariants(arm, q);
    // Each joint but the elbow has exactly one other turn inside +-360 deg (almost surely).
    ASSERT_EQ(variants.size(), 32u);
    for (const Vector6d& variant : variants) {
      ASSERT_TRUE(withinLimits(arm, variant));
      ASSERT_GE((variant - reference).cwiseAbs().sum() + 1e-9, (near - reference).cwiseAbs().sum());
    }
  }
}

}  // namespace
}  // namespace kiln
