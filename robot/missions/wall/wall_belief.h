#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "common/core/error.h"
#include "common/geom/pose.h"
#include "robot/perception/bricks/brick_poses.h"
#include "robot/skills/bricks/held_brick.h"

namespace kiln {

/// Where pile or marker were found.
struct FoundFrame {
  Pose2 X_map_frame;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< x, y (m), yaw (rad), axes of map
};

/// A brick of the pile as it was perceived.
struct PileBrick {
  BrickKind kind = BrickKind::Red;
  BrickState state = BrickState::Unseen;
  Eigen::Isometry3d X_map_brick = Eigen::Isometry3d::Identity();
  double confidence = 0.0;  ///< 0 to 1 that it lies there
  bool taken = false;       ///< from the pile, wherever it is now
  double along_m = 1.0;     ///< one sigma of where it lies along its length, m
};

/// What the wall mission knows of its site, and what survives a restart of the program. Confined to
/// the mission thread.
struct WallBelief {
  std::optional<FoundFrame> pile;  ///< nullopt: not found yet
  std::optional<FoundFrame> wall;  ///< wall frame on the ground, by the marker
  std::vector<PileBrick> bricks;   ///< as the pile's layout has them; empty: not looked at yet
  int pile_looks = 0, brick_looks = 0, marker_looks = 0;
  int drive_faults = 0;       ///< in a row
  int handling_faults = 0;    ///< in a row
  std::size_t stored = 0;     ///< so many steps of the plan's load were done
  std::size_t taken_out = 0;  ///< and so many of its steps of unloading
  /// What was set, in the order of building, as it was let go: X_wall_brick.
  std::vector<Eigen::Isometry3d> built;
  /// On the face. In the plan it is the one that was taken out last, unless that is built already:
  /// then the next one to be stored.
  std::optional<HeldBrick> held;

  /// A brick that was taken out is not set yet: it hangs on the gripper, or was lost.
  [[nodiscard]] bool unloading() const { return taken_out > built.size(); }
};

[[nodiscard]] nlohmann::json wallBeliefToJson(const WallBelief& belief);
/// Error{InvalidInput}: names what is missing, of the wrong type or out of range.
[[nodiscard]] Result<WallBelief> wallBeliefFromJson(const nlohmann::json& saved);

}  // namespace kiln
