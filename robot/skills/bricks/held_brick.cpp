#include "robot/skills/bricks/held_brick.h"

#include <cmath>

#include "robot/planning/arm_motion/arm_collision.h"

namespace kiln {
namespace {

Eigen::Vector3d sizeOf(BrickKind kind) {
  return {brickShape(kind).length_m, kBrickSide_m, kBrickSide_m};
}

}  // namespace

ArmPayload HeldBrick::payload(const RobotGeometry& robot) const {
  return {mass_kg(), (robot.X_flange_tool.pose() * X_tool_brick).translation()};
}

OrientedBox HeldBrick::inFlange(const RobotGeometry& robot) const {
  return makeBox(robot.X_flange_tool.pose() * X_tool_brick, sizeOf(kind), "held " + name);
}

Eigen::Isometry3d X_brick_face(const Eigen::Vector2d& offset_m, bool half_turn) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() << offset_m.x(), offset_m.y(), 0.5 * kBrickSide_m;
  X.linear() = (Eigen::AngleAxisd(half_turn ? M_PI : 0.0, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return X;
}

std::vector<OrientedBox> boxesOf(std::span<const KnownBrick> bricks) {
  std::vector<OrientedBox> boxes;
  for (const BoxConfig& box : obstacles(bricks))
    boxes.push_back(
        makeBox(box.center.pose(), {box.size_m[0], box.size_m[1], box.size_m[2]}, box.name));
  return boxes;
}

std::vector<std::string> touchedBy(const OrientedBox& body, std::span<const OrientedBox> boxes,
                                   double within_m) {
  std::vector<std::string> names;
  for (const OrientedBox& box : boxes) {
    if (body.bounds.exteriorDistance(box.bounds) > within_m) continue;
    if (box.name == body.name || distance(body, box) <= within_m) names.push_back(box.name);
  }
  if (body.bounds.min().z() <= within_m) names.emplace_back(kGroundName);
  return names;
}

}  // namespace kiln
