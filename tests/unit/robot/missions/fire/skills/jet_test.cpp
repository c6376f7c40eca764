#include "robot/missions/fire/skills/jet.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/geom/pose.h"

namespace kiln {
namespace {

TEST(Jet, MatchesTheFlightOfADropAtAnyPitch) {
  // A drop that leaves at 6 m/s: after t seconds it is 6 t along the line of exit and g t^2 / 2
  // below it.
  for (const double pitch : {-0.3, 0.0, 0.25}) {
    const Eigen::Isometry3d X = makePose({1.0, 2.0, 1.0}, {0.0, -pitch, 0.4});
    for (const double t : {0.05, 0.1, 0.15}) {
      const Eigen::Vector3d flown = X.translation() + 6.0 * t * X.linear().col(0) -
                                    0.5 * 9.81 * t * t * Eigen::Vector3d::UnitZ();
      EXPECT_LT((jetPoint({}, X, 6.0 * t, 1.0) - flown).norm(), 0.002);
    }
  }
}

TEST(Jet, PreviewEndsAtTheGround) {
  const auto points = jetPoints({}, makePose({0, 0, 0.3}, {0, 0, 0}), 1.0, 3.0, 0.05);
  ASSERT_GT(points.size(), 10u);
  for (const Eigen::Vector3d& p : points) EXPECT_GE(p.z(), 0.0);
  EXPECT_LT(points.back().z(), 0.06) << "the next point would be in the ground";
  EXPECT_NEAR(points.back().x(), std::sqrt(0.3 * 72.0 / 9.81), 0.06);
}

TEST(Jet, MissTellsSideHeightAndAngle) {
  // Level jet along -X from 0.7 m before the point, 0.1 m too high and 0.05 m to the left as seen
  // from the nozzle.
  const Eigen::Isometry3d X = makePose({0.7, -0.05, 1.1}, {0, 0, M_PI});
  const JetMiss miss = jetMiss({}, X, {0, 0, 1.0}, Eigen::Vector3d::UnitX(), 1.0);
  ASSERT_TRUE(miss.reaches);
  EXPECT_NEAR(miss.lateral_m, 0.05, 1e-9) << "looking along -X, left is -Y";
  EXPECT_NEAR(miss.vertical_m, 0.1 - 0.0668, 1e-3);
  // Slope of the parabola: g d / v^2 = 0.19; the table is linear over 20 cm, so up to 0.027 less.
  EXPECT_NEAR(miss.angle_rad, std::atan(9.81 * 0.7 / 36.0), 0.03);
}

TEST(Jet, AwayFromThePlaneNeverReachesIt) {
  const Eigen::Isometry3d X = makePose({0.7, 0, 1.0}, {0, 0, 0});
  EXPECT_FALSE(jetMiss({}, X, {0, 0, 1.0}, Eigen::Vector3d::UnitX(), 1.0).reaches);
}

}  // namespace
}  // namespace kiln
