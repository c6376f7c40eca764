#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/robot_model/robot_geometry.h"
#include "robot/hal/arm.h"
#include "robot/planning/arm_motion/shapes.h"
#include "robot/scene/obstacles.h"

namespace kiln {

/// The brick that hangs on the face.
struct HeldBrick {
  std::string name;
  BrickKind kind = BrickKind::Red;
  /// Where it hangs: its plate flush on the face, off its middle by the grasp's offset.
  Eigen::Isometry3d X_tool_brick = Eigen::Isometry3d::Identity();
  double weighed_kg = 0.0;  ///< as the force sensor found it

  [[nodiscard]] double mass_kg() const { return brickShape(kind).mass_kg; }
  /// Nominal weight, N.
  [[nodiscard]] double weight_n() const { return mass_kg() * 9.81; }
  /// What the arm is told of it, in flange axes.
  [[nodiscard]] ArmPayload payload(const RobotGeometry& robot) const;
  /// As a body fixed to the flange, in flange axes.
  [[nodiscard]] OrientedBox inFlange(const RobotGeometry& robot) const;
};

/// Where a face that is flush on the plate stands, seen from the brick: `offset_m` along X and Y
/// off its middle; with a half turn about the plate's normal, after which a brick looks the same.
[[nodiscard]] Eigen::Isometry3d X_brick_face(const Eigen::Vector2d& offset_m, bool half_turn);

/// Bricks as boxes, in the frame in which they are known.
[[nodiscard]] std::vector<OrientedBox> boxesOf(std::span<const KnownBrick> bricks);

/// Names of the boxes, and kGroundName, that a body at that place touches, or nearly: what it lies
/// on and what it is set against. All in base. A box of the body's own name is among them.
[[nodiscard]] std::vector<std::string> touchedBy(const OrientedBox& body,
                                                 std::span<const OrientedBox> boxes,
                                                 double within_m);

}  // namespace kiln
