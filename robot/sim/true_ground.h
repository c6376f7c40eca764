#pragma once

#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// The ground as it truly is: flat unless the world has the approach; slope and edge drawn by seed.
[[nodiscard]] GroundProfile drawGround(const WorldConfig& config, const ArenaMap& nominal,
                                       std::uint64_t seed);

/// The same as boxes under their surfaces, for physics and rays alike: start area, ramp, landing,
/// kitchen floor; a flat world is one box. Names begin with "floor".
[[nodiscard]] std::vector<SolidBox> groundBoxes(const GroundProfile& ground, double temperature_c);

}  // namespace kiln::sim
