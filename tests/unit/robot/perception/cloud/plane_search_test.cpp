#include "robot/perception/cloud/plane_search.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace kiln {
namespace {

/// 300 points of z = 0.1 x + 0.2 to a centimetre, 150 of the wall x = 3, 150 strewn about.
std::vector<Eigen::Vector3d> slopeBeforeAWall() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-3.0, 3.0), noise(-0.01, 0.01);
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < 300; ++i) {
    const double x = place(random), y = place(random);
    out.emplace_back(x, y, 0.1 * x + 0.2 + noise(random));
  }
  for (int i = 0; i < 150; ++i) out.emplace_back(3.0, place(random), place(random));
  for (int i = 0; i < 150; ++i) out.emplace_back(place(random), place(random), place(random));
  return out;
}

TEST(PlaneSearch, FindsTheOneThatFacesTheWayThatIsAskedFor) {
  const auto points = slopeBeforeAWall();
  PlaneSearch search;
  const auto ground = searchPlane(points, search);
  ASSERT_TRUE(ground.has_value());
  EXPECT_LT((ground->n - Eigen::Vector3d(-0.1, 0.0, 1.0).normalized()).norm(), 0.02);
  EXPECT_NEAR(ground->d_m, 0.2, 0.03);
  EXPECT_GE(ground->votes, 300U);
  search.towards = -Eigen::Vector3d::UnitX();
  const auto wall = searchPlane(points, search);
  ASSERT_TRUE(wall.has_value());
  EXPECT_LT(wall->n.x(), -0.98);
  EXPECT_NEAR(wall->d_m, -3.0, 0.05);
}

TEST(PlaneSearch, NothingCountsThatIsTooFarOffOrOnALine) {
  auto points = slopeBeforeAWall();
  PlaneSearch search;
  search.near = {0.0, 0.0, 10.0};
  search.near_m = 1.0;
  EXPECT_FALSE(searchPlane(points, search).has_value());
  for (Eigen::Vector3d& p : points) p.y() = p.z() = 0.0;
  EXPECT_FALSE(searchPlane(points, {}).has_value());
  EXPECT_FALSE(searchPlane(std::span(points).first(2), {}).has_value());
}

TEST(PlaneSearch, FewerVotersFindTheSamePlane) {
  const auto points = slopeBeforeAWall();
  PlaneSearch search;
  search.most_voters = 100;
  const auto ground = searchPlane(points, search);
  ASSERT_TRUE(ground.has_value());
  EXPECT_LE(ground->votes, 100U);
  EXPECT_GT(ground->n.z(), 0.98);
}

}  // namespace
}  // namespace kiln
