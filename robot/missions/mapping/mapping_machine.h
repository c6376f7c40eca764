#pragma once

#include <memory>
#include <string>

#include "robot/fsm/machine.h"
#include "robot/missions/mapping/mapping_context.h"

namespace kiln {

/// The states of the mapping drive.
/// @param mission_uuid  empty: a random one.
[[nodiscard]] std::unique_ptr<Machine> makeMappingMachine(MappingContext& context,
                                                          const std::string& mission_uuid);

}  // namespace kiln
