#include "robot/scene/wall_layout.h"

namespace kiln {

namespace {

constexpr double kLegOffset_m = kMarkerWidth_m / 2.0;  // of a leg's middle from the marker's edge

Eigen::Isometry3d pose(double x, double y, std::size_t layer, double yaw_rad) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(x, y, (static_cast<double>(layer) + 0.5) * kBrickSide_m);
  X.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return X;
}

}  // namespace

std::vector<WallSlot> wallSlots(const Blueprint& blueprint, double joint_m) {
  constexpr std::size_t kOrangePerLayer = 2;
  constexpr double kQuarterTurn_rad = 1.5707963267948966;
  std::vector<WallSlot> slots;
  if (blueprint.orange_leg)
    for (std::size_t layer = 0; layer < blueprint.layers.size(); ++layer) {
      double at = kLegOffset_m - kBrickSide_m / 2.0;
      for (std::size_t i = 0; i < kOrangePerLayer; ++i) {
        const double length = brickShape(BrickKind::Orange).length_m;
        slots.push_back({BrickKind::Orange, WallLeg::Orange, layer, i,
                         pose(kLegOffset_m, at + length / 2.0, layer, kQuarterTurn_rad)});
        at += length + joint_m;
      }
    }
  for (std::size_t layer = 0; layer < blueprint.layers.size(); ++layer) {
    double at = kLegOffset_m + kBrickSide_m / 2.0 + joint_m;
    for (std::size_t i = 0; i < blueprint.layers[layer].size(); ++i) {
      const BrickKind kind = blueprint.layers[layer][i];
      const double length = brickShape(kind).length_m;
      slots.push_back(
          {kind, WallLeg::Mixed, layer, i, pose(at + length / 2.0, kLegOffset_m, layer, 0.0)});
      at += length + joint_m;
    }
  }
  return slots;
}

}  // namespace kiln
