#include "robot/missions/wall/bin_exit.h"

#include <algorithm>
#include <array>

namespace kiln {
namespace {

/// Of the gripper's face, where nothing hangs on it: length, width and depth, m.
constexpr std::array kFace_m{0.18, 0.12, 0.02};
constexpr double kStep_m = 0.02;  ///< it is led out no farther than it takes

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
  const std::vector<OrientedBox> storage = context.storageNow();
  const auto backBy = [&](double by_m) -> Eigen::Isometry3d {
    return X_base_flange * X_flange_tool * Eigen::Translation3d(0, 0, -by_m);
  };
  const auto stands = [&](double by_m) {
    const OrientedBox body = heldOrFace(context, backBy(by_m));
    return std::any_of(storage.begin(), storage.end(), [&](const OrientedBox& box) {
      return distance(body, box) < handling.touching_m;
    });
  };
  if (!stands(0.0)) return false;
  double by_m = kStep_m;
  while (by_m < context.config.storage.before_m && stands(by_m)) by_m += kStep_m;
  ArmMoveTerms terms;
  terms.scene.boxes = context.aroundHands();
  for (const OrientedBox& box : storage) terms.scene.touchable.push_back(box.name);
  if (context.belief.held) terms.carried = context.belief.held->inFlange(parts.robot);
  terms.clearance_m = handling.line_clearance_m;
  terms.guard_force_n = handling.guard_n;
  terms.line_speed_mps = context.config.loading.store.leave_mps;
  terms.watch = false;  // the live cloud shows the very brick
  parts.arm.setTerms(std::move(terms));
  parts.arm.startCartesian({backBy(by_m) * X_flange_tool.inverse()}, false, now);
  return true;
}

}  // namespace kiln
