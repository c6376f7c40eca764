#pragma once

#include <vector>

#include "common/geom/pose.h"
#include "robot/scene/fire_site_map.h"

namespace kiln {

/// From inside the building to the work pose of a place. When `from_place` >= 0 its way-points lead
/// back to the hub. Way-points between which a disc of `radius_m` passes straight are left out.
[[nodiscard]] std::vector<Pose2> routeToPlace(const ArenaMap& arena, const FireSiteMap& site,
                                              const Pose2& here, int from_place, int to_place,
                                              double radius_m);

}  // namespace kiln
