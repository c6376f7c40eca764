#pragma once

#include <functional>

#include "common/core/clock.h"
#include "robot/missions/common/stowed_drive.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// What the states of the mapping drive share; references outlive it. Confined to the mission
/// thread.
struct MappingContext {
  const Clock& clock;
  const ArenaMap& arena;
  StowedDrive& drive;
  std::function<Pose2()> pose;  ///< newest X_map_base
  double rest_s = 1.0;          ///< before a drive is tried once more
  int max_faults = 1;           ///< of the whole round

  std::size_t passed = 0;  ///< way-points of the arena's mapping path that lie behind
  int faults = 0;
};

}  // namespace kiln
