#pragma once

#include <string>

#include "robot/evaluation/mission_run.h"
#include "robot/scene/fire_site_map.h"

namespace kiln {

/// The way of one run seen from above, as SVG: building, suspected fire places (red), planned way
/// with an arrow at each way-point (green), the way driven as the robot believed, in a new colour
/// after each reset, and the true way (dashed, if the run was traced). After the figure "Navigation
/// map and UGV trajectories" of the NimbRo UGV paper.
[[nodiscard]] std::string trajectorySvg(const MissionRun& run, const ArenaMap& arena,
                                        const FireSiteMap& site);

}  // namespace kiln
