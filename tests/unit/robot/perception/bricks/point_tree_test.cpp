#include "robot/perception/bricks/point_tree.h"

#include <random>

#include <gtest/gtest.h>

#include "robot/perception/bricks/point_clusters.h"

namespace kiln {
namespace {

std::vector<Eigen::Vector3f> randomPoints(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<Eigen::Vector3f> out;
  for (std::size_t i = 0; i < count; ++i)
    out.emplace_back(4.0F * unit(random), unit(random), 0.2F * unit(random));
  return out;
}

TEST(PointTree, FindsWhatAskingEveryPointFinds) {
  const auto points = randomPoints(700, 1), queries = randomPoints(200, 2);
  const PointTree tree(points);
  int found = 0;
  for (const Eigen::Vector3f& q : queries) {
    float least = 0.08F;
    for (const Eigen::Vector3f& p : points) least = std::min(least, (p - q).norm());
    const std::uint32_t i = tree.nearest(q, 0.08F);
    if (least >= 0.08F) {
      EXPECT_EQ(i, PointTree::kNone);
      continue;
    }
    ++found;
    ASSERT_NE(i, PointTree::kNone);
    EXPECT_FLOAT_EQ((points[i] - q).norm(), least);
  }
  EXPECT_GT(found, 50);
}

TEST(PointTree, OfNothingHasNothing) {
  EXPECT_EQ(PointTree({}).nearest(Eigen::Vector3f::Zero(), 1e3F), PointTree::kNone);
}

TEST(PointClusters, ApartByMoreThanTheGapAreTwo) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 20; ++i) points.emplace_back(0.05F * static_cast<float>(i), 0.0F, 0.0F);
  for (int i = 0; i < 10; ++i) points.emplace_back(2.0F, 0.05F * static_cast<float>(i), 0.0F);
  const auto clusters = clusterPoints(points, 0.1);
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_EQ(clusters[0].size(), 20U);
  EXPECT_EQ(clusters[1].size(), 10U);
}

TEST(PointClusters, OutlineLiesAlongTheLongerAxis) {
  std::vector<Eigen::Vector3f> points;
  const float c = std::cos(0.4F), s = std::sin(0.4F);
  for (int i = -10; i <= 10; ++i)
    for (int j = -2; j <= 2; ++j) {
      const float u = 0.1F * static_cast<float>(i), v = 0.1F * static_cast<float>(j);
      points.emplace_back(3.0F + c * u - s * v, 1.0F + s * u + c * v, 0.5F);
    }
  const GroundOutline outline = outlineOf(points);
  EXPECT_NEAR(outline.yaw_rad, 0.4, 1e-4);
  EXPECT_NEAR(outline.length_m, 2.0, 1e-4);
  EXPECT_NEAR(outline.width_m, 0.4, 1e-4);
  EXPECT_NEAR(outline.centre.x(), 3.0, 1e-4);
}

}  // namespace
}  // namespace kiln
