#include "robot/app/safety_files.h"

#include "common/config/required_keys.h"
#include "common/config/resources.h"

namespace kiln {
namespace {

template <class T>
Result<T> loadWith(const std::string& resource, const std::vector<std::string>& keys) {
  const auto path = resourcePath(resource);
  if (!path) return tl::make_unexpected(path.error());
  auto loaded = loadResource<T>(resource);
  if (!loaded) return loaded;
  if (auto complete = requireKeys(*path, keys); !complete)
    return tl::make_unexpected(complete.error());
  return loaded;
}

}  // namespace

Result<ArenaMap> loadArena(const std::string& resource) {
  return loadWith<ArenaMap>(
      resource, {"start", "approach", "walls", "furniture", "doorway", "entry_path", "geofence"});
}

Result<RobotGeometry> loadGeometry(const std::string& resource) {
  return loadWith<RobotGeometry>(
      resource, {"length_m", "width_m", "wheel_radius_m", "wheel_x_m", "wheel_y_m",
                 "steer_limit_deg", "steer_rate_deg_s", "max_wheel_speed_mps", "max_decel_mps2",
                 "body", "X_base_armbase", "head", "link_radius_m", "q_park_deg", "q_drive_deg"});
}

Result<SprayCalibration> loadSprayCalibration(const std::string& resource) {
  auto loaded = loadWith<SprayCalibration>(
      resource, {"exit_speed_mps", "distance_m", "drop_m", "lateral_m", "spread_deg"});
  if (!loaded) return loaded;
  if (auto valid = loaded->validate(); !valid) return tl::make_unexpected(valid.error());
  return loaded;
}

}  // namespace kiln
