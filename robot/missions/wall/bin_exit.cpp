#include "robot/missions/wall/bin_exit.h"

#include <algorithm>
#include <array>

namespace kiln {
namespace {

/// Of the gripper's face, where nothing hangs on it: length, width and depth, m.
constexpr std::array kFace_m{0.18, 0.12, 0.02};

OrientedBox heldOrFace(const WallContext& context, const Eigen::Isometry3d& X_base_tool) {
  const std::optional<HeldBrick>& held = context.belief.held;
  if (held)
    return makeBox(X_base_tool * held->X_tool_brick,
                   {brickShape(held->kind).length_m, kBrickSide_m, kBrickSide_m}, "brick");
  return makeBox(X_base_tool * Eigen::Translation3d(0, 0, -0.5 * kFace_m[2]),
                 {kFace_m[0], kFace_m[1], kFace_m[2]}, "gripper");
}

}  // namespace

bool BinExit::start(WallContext& context, Stamp now) {
  context_ = &context;
  const MissionParts& parts = context.parts;
  const auto arm = parts.arm_device.state();
  if (!arm) return false;
  const Eigen::Isometry3d X_base_flange = parts.robot.X_base_flange(arm->q);
  const Eigen::Isometry3d X_flange_tool = parts.robot.X_flange_tool.pose();
  const HandlingConfig& handling = context.config.loading.store.handling;
  const OrientedBox body = heldOrFace(context, X_base_flange * X_flange_tool);
  const std::vector<OrientedBox> storage = context.storageNow();
  if (std::none_of(storage.begin(), storage.end(), [&](const OrientedBox& box) {
        return distance(body, box) < handling.touching_m;
      }))
    return false;
  ArmMoveTerms terms;
  terms.scene.boxes = context.aroundHands();
  for (const OrientedBox& box : storage) terms.scene.touchable.push_back(box.name);
  if (context.belief.held) terms.carried = context.belief.held->inFlange(parts.robot);
  terms.clearance_m = handling.line_clearance_m;
  terms.guard_force_n = handling.guard_n;
  terms.line_speed_mps = context.config.loading.store.leave_mps;
  terms.watch = false;  // the live cloud shows the very brick
  parts.arm.setTerms(std::move(terms));
  const Eigen::Isometry3d back = X_flange_tool *
                                 Eigen::Translation3d(0, 0, -context.config.storage.before_m) *
                                 X_flange_tool.inverse();
  parts.arm.startCartesian({X_base_flange * back}, false, now);
  return true;
}

}  // namespace kiln
