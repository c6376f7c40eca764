#include "common/robot_model/storage_geometry.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"

namespace kiln {
namespace {

CompartmentConfig row() {
  CompartmentConfig c;
  c.name = "row";
  c.xyz_m = {-0.1, 0.02, 0.6};
  return c;
}

TEST(StorageGeometry, TheFloorFallsToTheBackAndTheWallsLean) {
  const Eigen::Isometry3d X = row().X_base_compartment(0.0);
  EXPECT_LT((X.translation() - Eigen::Vector3d(-0.1, 0.02, 0.6)).norm(), 1e-12);
  // It opens to the front of the robot: back is -X of base, 15 deg down.
  EXPECT_NEAR(X.linear()(0, 0), -std::cos(15 * kDeg), 1e-12);
  EXPECT_NEAR(X.linear()(2, 0), -std::sin(15 * kDeg), 1e-12);
  EXPECT_NEAR(X.linear()(0, 2), -std::sin(15 * kDeg), 1e-12) << "walls lean backwards";
  EXPECT_NEAR(X.linear()(2, 2), std::cos(15 * kDeg), 1e-12);
}

TEST(StorageGeometry, TravelsAlongItsRow) {
  const Eigen::Vector3d moved =
      row().X_base_compartment(0.3).translation() - row().X_base_compartment(0.0).translation();
  EXPECT_NEAR(moved.norm(), 0.3, 1e-12);
  EXPECT_NEAR(std::fabs(moved.y()), 0.3, 1e-12);
}

TEST(StorageGeometry, BinsAreAsWideAsThePaperSays) {
  const CompartmentConfig c = row();
  EXPECT_NEAR(c.pitch(), 0.21, 1e-12);
  EXPECT_NEAR(c.binY(2), 0.0, 1e-12);
  EXPECT_NEAR(c.binY(4), 0.42, 1e-12);
  const auto boxes = c.boxes();
  ASSERT_EQ(boxes.size(), 2U + 6U) << "floor, back and six walls";
  // Clear width between the walls beside the middle bin.
  const CompartmentBox &left = boxes[2 + 2], &right = boxes[2 + 3];
  const double clear = std::fabs(right.X_compartment_box.translation().y() -
                                 left.X_compartment_box.translation().y()) -
                       0.5 * (left.size_m.y() + right.size_m.y());
  EXPECT_NEAR(clear, 0.205, 1e-12);
  for (const CompartmentBox& box : boxes) EXPECT_GT(box.size_m.minCoeff(), 0.0) << box.name;
  EXPECT_NEAR(boxes[0].X_compartment_box.translation().z() + 0.5 * boxes[0].size_m.z(), 0.0, 1e-12)
      << "the floor's upper side is z = 0";
}

}  // namespace
}  // namespace kiln
