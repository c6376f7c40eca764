#include "robot/perception/marker/marker_shape.h"

#include <gtest/gtest.h>

namespace kiln::marker {
namespace {

TEST(MarkerShape, OutlineIsClosedCounterClockwiseAndFacesOutwards) {
  double twice_area = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Side& side = sides()[i];
    EXPECT_EQ(side.to, sides()[(i + 1) % 6].from);
    twice_area += side.from.x() * side.to.y() - side.to.x() * side.from.y();
    const Eigen::Vector2d middle = 0.5 * (side.from + side.to);
    EXPECT_GT(distanceOutside(middle + 0.05 * side.outward), 0.0);
    EXPECT_LT(distanceOutside(middle - 0.05 * side.outward), 0.0);
  }
  // Two legs of 4.02 x 0.42 m that share the corner's square; equal to 4.02 x 0.42 and 0.42 x 3.60.
  EXPECT_NEAR(0.5 * twice_area, 4.02 * 0.42 + 0.42 * 3.60, 1e-12);
}

TEST(MarkerShape, CellsFollowTheMiddleLineFromEndToEnd) {
  EXPECT_EQ(cellOf({4.0, 0.2}), 0);
  EXPECT_EQ(cellOf({0.2, 4.0}), kCells - 1);
  EXPECT_EQ(cellOf({2.0, 2.0}), -1);
  EXPECT_EQ(cellOf({-0.01, 0.2}), -1);
  int before = 0;
  for (double x = 4.0; x > 0.42; x -= 0.05) {
    const int cell = cellOf({x, 0.2});
    EXPECT_TRUE(cell == before || cell == before + 1) << x;
    before = cell;
  }
  // The corner's square lies in the two middle cells, whichever way it is reached.
  for (const double a : {0.05, 0.15, 0.35}) {
    EXPECT_NEAR(cellOf({a, 0.01}), cellOf({0.01, 0.42 - a}), 1);
    EXPECT_GE(cellOf({a, 0.01}), kCells / 2 - 2);
    EXPECT_LE(cellOf({a, 0.01}), kCells / 2 + 1);
  }
}

TEST(MarkerShape, DistanceIsThatToTheNearestSide) {
  EXPECT_NEAR(distanceOutside({2.0, 0.21}), -0.21, 1e-12);
  EXPECT_NEAR(distanceOutside({2.0, 0.72}), 0.30, 1e-12);
  EXPECT_NEAR(distanceOutside({-0.3, -0.4}), 0.50, 1e-12);
  EXPECT_NEAR(distanceOutside({4.32, 4.42}), 0.50 + 3.6 - 0.1, 0.5);
}

}  // namespace
}  // namespace kiln::marker
