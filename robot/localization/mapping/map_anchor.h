#pragma once

#include <span>
#include <vector>

#include "common/core/error.h"
#include "robot/localization/mapping/keyframe.h"
#include "robot/localization/surfel_map.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// Where a freely built map lies in the configured arena.
struct MapAnchor {
  Eigen::Isometry3d X_arena_map = Eigen::Isometry3d::Identity();
  double floor_rms_m = 0.0;  ///< of the floor's surfels about the plane
  int floor_surfels = 0;
  double wall_rms_m = 0.0, wall_rms_deg = 0.0;  ///< of single keyframes, after anchoring
  int wall_fixes = 0;                           ///< keyframes that saw enough of the walls
};

/// Way-points and fire places are given in the arena's frame, so the map must lie in it: the floor
/// inside the building gives height, roll and pitch (z = 0), its walls x, y and yaw, as the robust
/// mean of what BoxMapAligner finds for the keyframes inside.
/// @param map    of all keyframes, in the frame of `poses`; 0.5 m and 5 deg from the arena's.
/// @return Error{Degenerate} if there is no floor inside or fewer than three keyframes fit walls.
[[nodiscard]] Result<MapAnchor> anchorMap(const SurfelMap& map, std::span<const Keyframe> keyframes,
                                          std::span<const Eigen::Isometry3d> poses,
                                          const ArenaMap& arena);

/// Share of the walls' inner faces, 0.4 to 2.2 m above the floor, that has surfels within 10 cm.
[[nodiscard]] double wallCoverage(const SurfelMap& map, const ArenaMap& arena);

}  // namespace kiln
