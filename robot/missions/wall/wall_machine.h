#pragma once

#include <memory>
#include <string>

#include "robot/fsm/machine.h"
#include "robot/missions/wall/wall_context.h"

namespace kiln {

/// The states of the wall mission.
/// @param mission_uuid  empty: a random one.
[[nodiscard]] std::unique_ptr<Machine> makeWallMachine(WallContext& context,
                                                       const std::string& mission_uuid);

}  // namespace kiln
