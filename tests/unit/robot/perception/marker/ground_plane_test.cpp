#include "robot/perception/marker/ground_plane.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln {
namespace {

/// Points of a tilted ground, one in five of them on a box of 0.5 m. @param slope  along x and y.
PointCloud ground(double height, const Eigen::Vector2d& slope, int n, bool box) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(5.0, 12.0), y(-4.0, 4.0);
  std::normal_distribution<double> noise(0.0, 0.01);
  PointCloud out;
  for (int i = 0; i < n; ++i) {
    const double px = x(random), py = y(random);
    double z = height + slope.x() * px + slope.y() * py + noise(random);
    if (box && i % 5 == 0) z += 0.5;
    out.push(static_cast<float>(px), static_cast<float>(py), static_cast<float>(z), 10, 0, 0.0F);
  }
  out.push(NAN, 0.0F, 0.0F, 0, 0, 0.0F);
  return out;
}

TEST(GroundPlane, FindsTiltAndHeightBesideABox) {
  const auto plane = fitGroundPlane(ground(0.2, {-0.05, 0.02}, 3000, true), {8.5, 0.0}, {});
  ASSERT_TRUE(plane) << plane.error().message;
  // 3 deg = 0.052; the plane's own errors are those of a thousand points of 1 cm.
  EXPECT_NEAR(plane->coefficients[1], -0.05, 0.002);
  EXPECT_NEAR(plane->coefficients[2], 0.02, 0.002);
  EXPECT_NEAR(plane->height(8.5, 0.0), 0.2 - 0.05 * 8.5, 0.004);
  EXPECT_NEAR(plane->normal().norm(), 1.0, 1e-12);
  // What is common to all points stays: the mounting of the LiDAR.
  EXPECT_GE(std::sqrt(plane->covariance(1, 1)), 0.3 * kDeg);
  EXPECT_LT(std::sqrt(plane->covariance(1, 1)), 0.4 * kDeg);
}

TEST(GroundPlane, SaysHowManyPointsThereWereWhenTheyAreTooFew) {
  const auto few = fitGroundPlane(ground(0.0, {0.0, 0.0}, 50, false), {30.0, 0.0}, {});
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().code, ErrorCode::Degenerate);
  EXPECT_NE(few.error().message.find("0 LiDAR points"), std::string::npos) << few.error().message;
}

TEST(GroundPlane, RefusesWhatIsNoGround) {
  PointCloud wall;
  for (int i = 0; i < 400; ++i)
    wall.push(8.0F + 0.001F * static_cast<float>(i % 3), 0.01F * static_cast<float>(i % 20),
              0.05F * static_cast<float>(i / 20), 10, 0, 0.0F);
  EXPECT_FALSE(fitGroundPlane(wall, {8.0, 0.0}, {}));
}

TEST(GroundPlane, RayMeetsItWhereItShould) {
  GroundPlane plane;
  plane.coefficients = {0.1, 0.05, 0.0};
  const Eigen::Vector3d p = plane.meet({0.0, 0.0, 2.0}, {1.0, 0.0, -0.14});
  EXPECT_NEAR(p.x(), 1.9 / 0.19, 1e-9);
  EXPECT_NEAR(p.z(), plane.height(p.x(), 0.0), 1e-9);
  EXPECT_FALSE(plane.meet({0.0, 0.0, 2.0}, {1.0, 0.0, 0.06}).allFinite());
}

// The robot stands on the lower level, the ray goes to the upper one: the first guess, the plane
// under the wheels, is 2 m too far.
TEST(GroundPlane, AlongARayItIsTheGroundWhereTheRayEnds) {
  const PointCloud scan = ground(0.3, {0.0, 0.0}, 3000, false);
  const Eigen::Vector3d eye(0.9, 0.0, 1.9), to(9.0, 0.0, 0.3);
  const auto plane = groundAlongRay(scan, eye, to - eye, 20.0, {});
  ASSERT_TRUE(plane) << plane.error().message;
  EXPECT_NEAR(plane->meet(eye, to - eye).x(), 9.0, 0.05);
}

}  // namespace
}  // namespace kiln
