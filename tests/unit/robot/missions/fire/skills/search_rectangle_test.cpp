#include "robot/missions/fire/skills/search_rectangle.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

const Eigen::Vector3d kPlate(12.1, 2.8, 1.0);
const Eigen::Vector3d kTowardsRobot(-1, 0, 0);

TEST(SearchRectangle, EveryPoseLooksAtThePlaceUpright) {
  for (const Eigen::Isometry3d& X : searchRectangle(kPlate, kTowardsRobot, 1.0, 0.25, 0.12)) {
    const Eigen::Vector3d p_thermal = X.inverse() * kPlate;
    EXPECT_NEAR(p_thermal.x(), 0.0, 1e-9);
    EXPECT_NEAR(p_thermal.y(), 0.0, 1e-9);
    EXPECT_GT(p_thermal.z(), 0.99);
    EXPECT_NEAR(X.linear()(2, 0), 0.0, 1e-9) << "the image's X stays level";
    EXPECT_LT(X.linear()(2, 1), 0.0) << "the image's Y points down";
    EXPECT_NEAR(X.linear().determinant(), 1.0, 1e-9);
  }
}

TEST(SearchRectangle, GoesRoundFromTheTopLeftAndEndsInTheMiddle) {
  const auto poses = searchRectangle(kPlate, kTowardsRobot, 1.0, 0.25, 0.12);
  ASSERT_EQ(poses.size(), 6u);
  // The camera looks along +X: its left is +Y.
  EXPECT_TRUE(poses[0].translation().isApprox(Eigen::Vector3d(11.1, 3.05, 1.12)));
  EXPECT_TRUE(poses[1].translation().isApprox(Eigen::Vector3d(11.1, 2.55, 1.12)));
  EXPECT_TRUE(poses[2].translation().isApprox(Eigen::Vector3d(11.1, 2.55, 0.88)));
  EXPECT_TRUE(poses[3].translation().isApprox(Eigen::Vector3d(11.1, 3.05, 0.88)));
  EXPECT_TRUE(poses[4].translation().isApprox(poses[0].translation()));
  EXPECT_TRUE(poses[5].translation().isApprox(Eigen::Vector3d(11.1, 2.8, 1.0)));
}

}  // namespace
}  // namespace kiln
