#include "robot/scene/wall_layout.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

using enum BrickKind;

TEST(WallLayout, StandsOnItsMarkerWithTheJointsAsPlanned) {
  Blueprint blueprint;
  blueprint.layers.assign(kWallLayers, {Red, Green, Blue, Red, Red, Green, Red});
  const auto slots = wallSlots(blueprint);
  ASSERT_EQ(slots.size(), 45U);

  const WallSlot* left = nullptr;
  for (const WallSlot& slot : slots) {
    const double half = brickShape(slot.kind).length_m / 2.0;
    const Eigen::Vector3d along = slot.X_wall_brick.linear().col(0) * half;
    const Eigen::Vector3d across = slot.X_wall_brick.linear().col(1) * kBrickSide_m / 2.0;
    const Eigen::Vector3d p = slot.X_wall_brick.translation();
    for (const double a : {-1.0, 1.0})
      for (const double c : {-1.0, 1.0}) {
        const Eigen::Vector3d corner = p + a * along + c * across;
        EXPECT_GE(corner.minCoeff(), 0.0);
        EXPECT_LE(corner.head<2>().maxCoeff(), kMarkerLength_m);
        EXPECT_LE(corner.head<2>().minCoeff(), kMarkerWidth_m);  // on a leg of the marker
      }
    EXPECT_NEAR(p.z(), 0.1 + 0.2 * static_cast<double>(slot.layer), 1e-12);
    if (left != nullptr && left->leg == slot.leg && left->layer == slot.layer) {
      const double between = (p - left->X_wall_brick.translation()).norm();
      EXPECT_NEAR(between, half + brickShape(left->kind).length_m / 2.0 + kPlannedJoint_m, 1e-12);
    }
    left = &slot;
  }
}

TEST(WallLayout, HasTheCountsOfTheTask) {
  int bricks = 0, points = 0;
  for (const BrickShape& shape : kBrickShapes) {
    bricks += shape.count;
    points += shape.count * shape.points;
    EXPECT_EQ(brickShape(shape.kind).letter, shape.letter);
  }
  EXPECT_EQ(bricks, 45);
  EXPECT_EQ(points, 20 + 20 + 15 + 40);
}

}  // namespace
}  // namespace kiln
