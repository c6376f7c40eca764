#pragma once

#include "robot/safety/geofence.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// The arena's fence for a robot: its polygon, or the box of its limits where none is drawn.
[[nodiscard]] Result<Geofence> arenaFence(const ArenaMap& arena, const RobotGeometry& robot,
                                          const Geofence::Config& config);

}  // namespace kiln
