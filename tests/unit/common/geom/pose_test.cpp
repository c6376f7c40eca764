#include "common/geom/pose.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln {
namespace {

class PoseProperties : public ::testing::Test {
 protected:
  Pose2 randomPose() { return {position_(random_), position_(random_), angle_(random_)}; }
  std::mt19937 random_{42};
  std::uniform_real_distribution<double> position_{-20.0, 20.0};
  std::uniform_real_distribution<double> angle_{-M_PI, M_PI};
};

void expectNear(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x_m, b.x_m, 1e-9);
  EXPECT_NEAR(a.y_m, b.y_m, 1e-9);
  EXPECT_NEAR(wrapAngle(a.yaw_rad - b.yaw_rad), 0.0, 1e-9);
}

TEST_F(PoseProperties, GroundPosesFormAGroup) {
  for (int i = 0; i < 200; ++i) {
    const Pose2 a = randomPose(), b = randomPose(), c = randomPose();
    expectNear(a * inverse(a), {});
    expectNear(inverse(a) * a, {});
    expectNear((a * b) * c, a * (b * c));
    expectNear(inverse(a * b), inverse(b) * inverse(a));
  }
}

TEST_F(PoseProperties, GroundPosesAgreeWithIsometries) {
  for (int i = 0; i < 200; ++i) {
    const Pose2 a = randomPose(), b = randomPose();
    EXPECT_TRUE(toIsometry(a * b).isApprox(toIsometry(a) * toIsometry(b), 1e-12));
    expectNear(projectToGround(toIsometry(a)), a);
  }
}

TEST(WrapAngle, IsHalfOpenFromMinusPiToPi) {
  EXPECT_DOUBLE_EQ(wrapAngle(0.0), 0.0);
  EXPECT_DOUBLE_EQ(wrapAngle(M_PI), M_PI);
  EXPECT_DOUBLE_EQ(wrapAngle(-M_PI), M_PI);
  EXPECT_NEAR(wrapAngle(3.5 * M_PI), -0.5 * M_PI, 1e-12);
  EXPECT_NEAR(wrapAngle(-7.0), -7.0 + 2.0 * M_PI, 1e-12);
}

TEST(MakePose, TurnsByRollThenPitchThenYawAboutFixedAxes) {
  // Roll 90: Y -> Z. Pitch leaves Z turned by 0. Yaw 90 about Z then leaves it there; X -> Y.
  const Eigen::Isometry3d X = makePose({1, 2, 3}, {90 * kDeg, 0, 90 * kDeg});
  EXPECT_TRUE((X * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d(1, 2, 4), 1e-12));
  EXPECT_TRUE((X * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(1, 3, 3), 1e-12));
  // Pitch 90 turns X down.
  EXPECT_TRUE((makePose({0, 0, 0}, {0, 90 * kDeg, 0}) * Eigen::Vector3d::UnitX())
                  .isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(FrameFromXAndUp, IsARotationWhoseXIsGivenAndWhoseYIsLevel) {
  const Eigen::Vector3d x(1, -2, 0.7);
  const Eigen::Matrix3d R = frameFromXAndUp(x, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE((R * R.transpose()).isIdentity(1e-12));
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  EXPECT_TRUE(R.col(0).isApprox(x.normalized(), 1e-12));
  EXPECT_NEAR(R(2, 1), 0.0, 1e-12);
  EXPECT_GT(R(2, 2), 0.0);
}

TEST(Interpolate, MeetsItsEndsAndTurnsEvenly) {
  const Eigen::Isometry3d a = makePose({0, 0, 0}, {0, 0, 0}),
                          b = makePose({2, 0, 4}, {0, 0, 80 * kDeg});
  EXPECT_TRUE(interpolate(a, b, 0.0).isApprox(a, 1e-12));
  EXPECT_TRUE(interpolate(a, b, 1.0).isApprox(b, 1e-12));
  const Eigen::Isometry3d middle = interpolate(a, b, 0.25);
  EXPECT_TRUE(middle.translation().isApprox(Eigen::Vector3d(0.5, 0, 1.0), 1e-12));
  EXPECT_NEAR(rotationAngle(middle), 20 * kDeg, 1e-12);
}

TEST(IsFinite, RefusesNanAndInfinity) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  EXPECT_TRUE(isFinite(X));
  X.translation().y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isFinite(X));
  X = Eigen::Isometry3d::Identity();
  X.linear()(0, 1) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(isFinite(X));
}

}  // namespace
}  // namespace kiln
