#include "robot/perception/marker/ground_cluster.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/perception/marker/marker_shape.h"

namespace kiln::marker {
namespace {

/// The marker as points, 4 cm apart, its wall frame at X. @param keep  what is seen of it.
template <class Keep>
std::vector<Eigen::Vector2f> lPoints(const Pose2& X, Keep keep) {
  std::vector<Eigen::Vector2f> out;
  for (double x = 0.0; x <= kMarkerLength_m; x += 0.04)
    for (double y = 0.0; y <= kMarkerLength_m; y += 0.04) {
      if (distanceOutside({x, y}) > 0.0 || !keep(x, y)) continue;
      const Pose2 p = X * Pose2{x, y, 0.0};
      out.emplace_back(static_cast<float>(p.x_m), static_cast<float>(p.y_m));
    }
  return out;
}
std::vector<Eigen::Vector2f> wholeL(const Pose2& X) {
  return lPoints(X, [](double, double) { return true; });
}

TEST(GroundCluster, SeparatesWhatIsFartherApartThanTheGap) {
  std::vector<Eigen::Vector2f> points = wholeL({5.0, 1.0, 0.3});
  const std::size_t marker = points.size();
  for (const Eigen::Vector2f& p :
       lPoints({20.0, 0.0, 0.0}, [](double x, double y) { return x < 1.0 && y < 1.0; }))
    points.push_back(p);
  points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F);
  const auto clusters = clusterGround(points, {});
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_EQ(clusters[0].points.size(), marker);
  EXPECT_NEAR(clusters[0].rectangle.long_m, kMarkerLength_m, 0.06);
  EXPECT_NEAR(clusters[0].rectangle.short_m, kMarkerLength_m, 0.06);
  EXPECT_TRUE(clusterGround({}, {}).empty());
}

TEST(GroundCluster, SingleHitsAreNoClusterWhereMoreAreAsked) {
  std::vector<Eigen::Vector2f> points = wholeL({});
  const auto own = points;
  points.insert(points.end(), own.begin(), own.end());
  points.emplace_back(9.0F, 9.0F);
  GroundClusterConfig config;
  config.min_hits = 2;
  EXPECT_EQ(clusterGround(points, config).size(), 1U);
  config.min_hits = 1;
  EXPECT_EQ(clusterGround(points, config).size(), 2U);
}

// An L of equal legs has a corner and a handedness: with Z up, X and Y cannot be swapped. So one
// pose comes out whichever way it lies, and never the one turned by 90 degrees.
TEST(GroundCluster, PoseOfAnLIsUniqueInEveryDirection) {
  for (int degrees = -180; degrees < 180; degrees += 7) {
    const Pose2 truth{8.0, -3.0, degrees * kDeg};
    const auto points = wholeL(truth);
    const auto clusters = clusterGround(points, {});
    ASSERT_EQ(clusters.size(), 1U);
    const LCorner found = findLCorner(clusters[0], points);
    EXPECT_NEAR(found.X_ground_wall.x_m, truth.x_m, 0.06) << degrees;
    EXPECT_NEAR(found.X_ground_wall.y_m, truth.y_m, 0.06) << degrees;
    EXPECT_NEAR(wrapAngle(found.X_ground_wall.yaw_rad - truth.yaw_rad), 0.0, 1.0 * kDeg) << degrees;
    EXPECT_NEAR(found.empty_m, kMarkerLength_m - kMarkerWidth_m, 0.1);
    EXPECT_LT(found.next_m, 0.1);
    // The first leg, turned counter-clockwise about the corner, meets the second one.
    const Pose2 on_y = found.X_ground_wall * Pose2{0.2, 3.0, 0.0};
    double nearest = 10.0;
    for (const auto& p : points)
      nearest = std::min(nearest, std::hypot(static_cast<double>(p.x()) - on_y.x_m,
                                             static_cast<double>(p.y()) - on_y.y_m));
    EXPECT_LT(nearest, 0.1) << degrees;
  }
}

TEST(GroundCluster, CornerIsFoundThoughItIsHiddenItself) {
  const Pose2 truth{3.0, 2.0, 1.0};
  const auto points = lPoints(truth, [](double x, double y) { return x > 0.25 || y > 0.25; });
  GroundClusterConfig config;
  config.gap_m = 1.5;
  const auto clusters = clusterGround(points, config);
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_NEAR(findLCorner(clusters[0], points).X_ground_wall.x_m, truth.x_m, 0.06);
}

}  // namespace
}  // namespace kiln::marker
