#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/geom/pose.h"
#include "robot/scene/wall_layout.h"

namespace kiln::sim {

/// A brick as the referee sees it; only what lies still and free counts.
struct LyingBrick {
  BrickKind kind = BrickKind::Red;
  Eigen::Isometry3d X_map_brick = Eigen::Isometry3d::Identity();
};

struct WallScore {
  /// Fitted to the first layer near the marker; nullopt: nothing was built there.
  std::optional<Pose2> X_map_wall;
  std::vector<std::optional<std::size_t>> brick_in_slot;  ///< by slot, index of the brick
  std::size_t placed = 0;
  double points = 0.0;
  double off_marker_m = 0.0, off_marker_rad = 0.0;  ///< of the fitted frame from the marker's
};

/// Score of Challenge 2 (scenario.md section 4): a brick counts that lies within 5 cm and 5 deg of
/// its slot, level, and on something; the wall's frame is fitted to the bricks of the first layer.
/// @param X_map_marker true frame of the marker, on the ground; the wall stands within 2 m of it
[[nodiscard]] WallScore scoreWall(std::span<const WallSlot> slots,
                                  std::span<const LyingBrick> bricks,
                                  const Eigen::Isometry3d& X_map_marker);

}  // namespace kiln::sim
