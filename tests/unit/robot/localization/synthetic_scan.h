#pragma once

#include <cstdint>
#include <vector>

#include "common/model/sensor.h"
#include "robot/scene/arena_map.h"

namespace kiln::testing {

/// The arena as it stands in resources/config. Ends the process when it does not load.
[[nodiscard]] ArenaMap kitchen();

struct ScanSettings {
  std::vector<BoxConfig> boxes;  ///< everything that returns rays, in map
  Eigen::Vector3d p_base_sensor{0.5, 0.0, 1.45};
  double bias_sigma_m = 0.010;  ///< per laser, fixed by seed (scenario.md section 2)
  double noise_sigma_m = 0.010;
  double dropout = 0.005;
  double random_return_fraction =
      0.0;  ///< rays that end somewhere before the wall: hose, dust, people
  int directions = 900;
  std::uint32_t seed = 1;
  bool flat_floor = true;  ///< z = 0 everywhere; false: only what `boxes` hold
  /// True against configured place of the LiDAR.
  Eigen::Isometry3d X_sensor_truesensor = Eigen::Isometry3d::Identity();
};

/// 16 lasers from -15 to 15 deg, `directions` a laser; a slab test against each box. Points in
/// base.
[[nodiscard]] PointCloud castScan(const ScanSettings& settings,
                                  const Eigen::Isometry3d& X_map_base);
[[nodiscard]] PointCloud castScan(const ScanSettings& settings, const Pose2& X_map_base);

/// Furniture and fire boxes moved by up to `metres` and 5 deg.
[[nodiscard]] std::vector<BoxConfig> moved(std::vector<BoxConfig> boxes, double metres,
                                           std::uint32_t seed);

[[nodiscard]] BoxConfig makeBox(double x, double y, double z, double sx, double sy, double sz);

}  // namespace kiln::testing
