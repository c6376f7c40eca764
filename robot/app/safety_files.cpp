#include "robot/app/safety_files.h"

#include "common/config/required_keys.h"
#include "robot/missions/catalog.h"

namespace kiln {
Result<ArenaMap> loadArena(const std::string& resource) {
  // In the open there is nothing to run into and no door, which the file then says.
  auto arena =
      loadComplete<ArenaMap>(resource, {"start", "approach", "doorway", "sites", "geofence"},
                             {"walls", "furniture", "entry_path"});
  if (!arena) return arena;
  if (auto furnished = furnish(*arena); !furnished) return tl::make_unexpected(furnished.error());
  return arena;
}

Result<RobotGeometry> loadGeometry(const std::string& resource) {
  return loadComplete<RobotGeometry>(
      resource, {"length_m", "width_m", "wheel_radius_m", "wheel_x_m", "wheel_y_m",
                 "steer_limit_deg", "steer_rate_deg_s", "max_wheel_speed_mps", "max_decel_mps2",
                 "body", "X_base_armbase", "head", "arm_shapes", "q_park_deg", "q_drive_deg"});
}

}  // namespace kiln
