#include "robot/skills/arena_fence.h"

namespace kiln {

Result<Geofence> arenaFence(const ArenaMap& arena, const RobotGeometry& robot,
                            const Geofence::Config& config) {
  std::vector<Eigen::Vector2d> corners;
  for (const GroundPointConfig& corner : arena.geofence)
    corners.emplace_back(corner.xy_m[0], corner.xy_m[1]);
  if (corners.empty())
    corners = {{arena.geofence_x_min_m, arena.geofence_y_min_m},
               {arena.geofence_x_max_m, arena.geofence_y_min_m},
               {arena.geofence_x_max_m, arena.geofence_y_max_m},
               {arena.geofence_x_min_m, arena.geofence_y_max_m}};
  return Geofence::create(config, std::move(corners), robot.length_m, robot.width_m);
}

}  // namespace kiln
