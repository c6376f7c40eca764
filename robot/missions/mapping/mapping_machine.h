#pragma once

#include <memory>
#include <string>

#include "robot/fsm/machine.h"
#include "robot/missions/mapping/mapping_context.h"

namespace kiln {

/// The mapping drive: one round along the arena's mapping path and back to where it began, arm
/// stowed, so that the map made of its recording closes a loop. Needs no map: locate by walls.
/// @param mission_uuid  empty: a random one.
[[nodiscard]] std::unique_ptr<Machine> makeMappingMachine(MappingContext& context,
                                                          const std::string& mission_uuid);

}  // namespace kiln
