#pragma once

#include <string>

#include "common/robot_model/robot_geometry.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// The files on which the robot's limits rest. Each must state what safety needs: an absent fence,
/// wall or footprint is an error with file and name, never a default.
/// Errors: those of loadComplete().
[[nodiscard]] Result<ArenaMap> loadArena(const std::string& resource);
/// Mountings may be left out: a missing one is a row of the preflight.
[[nodiscard]] Result<RobotGeometry> loadGeometry(const std::string& resource);

}  // namespace kiln
