#pragma once

#include <memory>
#include <string>

#include "robot/fsm/machine.h"
#include "robot/missions/fire/fire_context.h"

namespace kiln {

/// The state machine of Challenge 3 (NimbRo UGV paper, figure "Flowchart of the Challenge 3 UGV
/// state machine").
/// @param mission_uuid  empty: a random one.
[[nodiscard]] std::unique_ptr<Machine> makeFireMachine(FireContext& context,
                                                       const std::string& mission_uuid);

}  // namespace kiln
