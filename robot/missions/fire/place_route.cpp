#include "robot/missions/fire/place_route.h"

#include "robot/missions/common/route.h"

namespace kiln {

std::vector<Pose2> routeToPlace(const ArenaMap& arena, const FireSiteMap& site, const Pose2& here,
                                int from_place, int to_place, double radius_m) {
  std::vector<Pose2> route;
  if (from_place >= 0 && from_place != to_place) {
    const auto& via = site.places[static_cast<std::size_t>(from_place)].via;
    for (auto it = via.rbegin(); it != via.rend(); ++it) route.push_back(it->pose());
    if (!arena.entry_path.empty()) route.push_back(arena.entry_path.back().pose());
  }
  const FirePlaceConfig& place = site.places[static_cast<std::size_t>(to_place)];
  if (from_place != to_place)
    for (const GroundPoseConfig& way_point : place.via) route.push_back(way_point.pose());
  route.push_back(place.work_pose.pose());
  return shortened(arena, here, route, radius_m);
}

}  // namespace kiln
