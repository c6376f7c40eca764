#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "robot/scene/brick.h"

namespace kiln {

inline constexpr std::size_t kWallLayers = 5;

/// What the wall is to be: the kinds of each layer's bricks, layer 0 at the ground, each from left
/// to right as seen by the robot that builds (along the wall's X).
/// The official form has seven bricks a layer (4 R, 2 G, 1 B); the lab's has fewer layers and bricks.
struct Blueprint {
  std::vector<std::vector<BrickKind>> layers;
  bool orange_leg = true;  ///< the second leg of the L, two orange bricks a layer, is implied
};

enum class WallLeg : std::uint8_t { Mixed, Orange };

/// One place for a brick. Wall frame: on the ground, at the outer corner of the marker's L; X along
/// the leg of the blueprint (the front line), Y along the orange leg, Z up.
struct WallSlot {
  BrickKind kind = BrickKind::Red;
  WallLeg leg = WallLeg::Mixed;
  std::size_t layer = 0;
  std::size_t index = 0;  ///< within its layer and leg, along the leg
  Eigen::Isometry3d X_wall_brick = Eigen::Isometry3d::Identity();
};

/// The wall on its marker: both legs run along the middle of the marker's (0.42 m wide); the orange
/// leg reaches into the corner, the leg of the blueprint begins beside it.
inline constexpr double kMarkerWidth_m = 0.42;
inline constexpr double kMarkerLength_m = 4.02;   ///< of both legs, the corner included
inline constexpr double kPlannedJoint_m = 0.003;  ///< between neighbours (scenario.md section 4)

/// All slots: orange leg first, then the blueprint's, each layer by layer from the ground, in order
/// along its leg. @param joint_m between neighbours of a layer
[[nodiscard]] std::vector<WallSlot> wallSlots(const Blueprint& blueprint,
                                              double joint_m = kPlannedJoint_m);

}  // namespace kiln
