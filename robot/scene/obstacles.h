#pragma once

#include <vector>

#include "robot/scene/arena_map.h"

namespace kiln {

/// Everything in the arena that a robot can run into, where it is believed to stand now: the one
/// source for driving, arm motion, jogs and routes. To be asked anew for each motion, because a
/// mission may have moved what stands elsewhere.
[[nodiscard]] std::vector<BoxConfig> obstacles(const ArenaMap& arena);

}  // namespace kiln
