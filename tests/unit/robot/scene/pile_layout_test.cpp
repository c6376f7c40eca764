#include "robot/scene/pile_layout.h"

#include <array>

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(PileLayout, HoldsTheBricksOfTheTask) {
  const auto slots = arenaPile().slots();
  ASSERT_EQ(slots.size(), 45U);
  std::array<int, kBrickKinds> count{};
  for (const PileSlot& slot : slots) ++count[static_cast<std::size_t>(slot.kind)];
  for (const BrickShape& shape : kBrickShapes)
    EXPECT_EQ(count[static_cast<std::size_t>(shape.kind)], shape.count) << shape.name;
}

TEST(PileLayout, LineOneIsAsLongAsThePageSaysAndLineTwoStandsBehindIt) {
  // 4 x 0.3 + 2 x 0.6 + 1.2 and six gaps of 0.1; 2 x 1.8 and one gap.
  EXPECT_NEAR(arenaPile().length(), 4.2, 1e-12);
  double line1 = 0.0, line2 = 0.0;
  for (const PileSlot& slot : arenaPile().slots()) {
    const Eigen::Vector3d& p = slot.X_pile_brick.translation();
    const double end = p.x() + brickShape(slot.kind).length_m / 2.0;
    (p.y() > 1.0 ? line2 : line1) = std::max(p.y() > 1.0 ? line2 : line1, end);
    if (slot.kind == BrickKind::Orange) {
      EXPECT_NEAR(p.y(), 2.6, 1e-12);
    }
  }
  EXPECT_NEAR(line1, 4.2, 1e-12);
  EXPECT_NEAR(line2, 3.7, 1e-12);
}

TEST(PileLayout, NeighboursStandAGapApartAndLayersOnEachOther) {
  const auto slots = labPile().slots();
  ASSERT_EQ(slots.size(), 11U);
  EXPECT_NEAR(slots[0].X_pile_brick.translation().z(), 0.1, 1e-12);
  EXPECT_NEAR(slots[3].X_pile_brick.translation().z(), 0.7, 1e-12);
  // The first green one: behind 0.3 m of red and the gap, half its own length on.
  EXPECT_NEAR(slots[4].X_pile_brick.translation().x(), 0.3 + 0.1 + 0.3, 1e-12);
}

}  // namespace
}  // namespace kiln
