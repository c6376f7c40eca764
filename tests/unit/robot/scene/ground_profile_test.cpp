#include "robot/scene/ground_profile.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;

const ApproachConfig kApproach{1.0, 3.2, 4.0, 3.6, 0.02};
const double kRise = 2.2 * std::tan(4.0 * kDeg);  // 0.1538 m over the ramp

/// Height of each wheel's contact point above the ground.
Eigen::Vector4d clearances(const GroundProfile& ground, const Eigen::Isometry3d& X,
                           const RobotGeometry& robot) {
  Eigen::Vector4d out;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d p =
        X * Eigen::Vector3d(i < 2 ? robot.wheel_x_m : -robot.wheel_x_m,
                            i % 2 == 0 ? robot.wheel_y_m : -robot.wheel_y_m, 0);
    out[i] = p.z() - ground.height(p.x());
  }
  return out;
}

TEST(GroundProfile, WithoutApproachIsFlat) {
  const GroundProfile ground;
  EXPECT_TRUE(ground.flat());
  for (const double x : {-50.0, -1.0, 0.0, 7.0}) EXPECT_EQ(ground.height(x), 0.0);
  const Pose2 at{3, -2, 0.7};
  EXPECT_TRUE(ground.standing(at, {}).isApprox(toIsometry(at), 1e-12));
}

TEST(GroundProfile, RisesFromTheStartToTheKitchenFloor) {
  const GroundProfile ground(kApproach);
  EXPECT_FALSE(ground.flat());
  EXPECT_NEAR(ground.lowest(), -0.02 - kRise, 1e-12);
  EXPECT_NEAR(ground.height(-3.0), ground.lowest(), 1e-12);
  EXPECT_NEAR(ground.height(2.1), -0.02 - 0.5 * kRise, 1e-12);
  EXPECT_NEAR(ground.height(3.4), -0.02, 1e-12);
  EXPECT_EQ(ground.height(3.6), 0.0);
  EXPECT_EQ(ground.height(12.0), 0.0);
}

TEST(GroundProfile, ARobotOnTheRampTouchesItWithAllWheelsWhateverItsHeading) {
  const GroundProfile ground({-20, 20, 4.0, 21, 0.02});
  const RobotGeometry robot;
  for (double yaw = -3.0; yaw <= 3.0; yaw += 0.5) {
    const Pose2 at{1.5, 0.3, yaw};
    const Eigen::Isometry3d X = ground.standing(at, robot);
    EXPECT_LT(clearances(ground, X, robot).cwiseAbs().maxCoeff(), 1e-9) << yaw;
    EXPECT_NEAR(std::acos(X.linear()(2, 2)) * 180 / M_PI, 4.0, 1e-9);
    const Pose2 back = projectToGround(X);
    EXPECT_NEAR(back.x_m, at.x_m, 1e-12);
    EXPECT_NEAR(wrapAngle(back.yaw_rad - yaw), 0.0, 1e-9);
  }
}

TEST(GroundProfile, OverKinksAndEdgeNoWheelIsInTheGround) {
  const GroundProfile ground(kApproach);
  const RobotGeometry robot;
  for (double x = -0.497; x < 5.0; x += 0.05) {
    for (const double yaw : {0.0, 0.4, 1.6}) {
      const Eigen::Vector4d c = clearances(ground, ground.standing({x, 0, yaw}, robot), robot);
      // Straddling the edge turned, the plane through four heights misses them by 1 cm at most.
      EXPECT_GT(c.minCoeff(), -0.001) << x << " " << yaw;
      EXPECT_LT(c.minCoeff(), 0.001) << x << " " << yaw;
      EXPECT_LT(c.maxCoeff(), 0.025) << x << " " << yaw;
    }
  }
}

TEST(ApproachConfig, RefusesPiecesOutOfOrder) {
  EXPECT_TRUE(kApproach.validate().has_value());
  EXPECT_TRUE(ApproachConfig{}.validate().has_value());
  const auto bad = ApproachConfig{1.0, 3.2, 4.0, 3.0, 0.02}.validate();
  ASSERT_FALSE(bad.has_value());
  EXPECT_THAT(bad.error().message, HasSubstr("edge at 3 m"));
}

}  // namespace
}  // namespace kiln
