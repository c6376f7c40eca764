#pragma once

#include <memory>

#include "robot/localization/surfel_map.h"
#include "tests/unit/robot/localization/synthetic_scan.h"

namespace kiln::testing {

/// Puts a scan taken at a known pose into a map.
SurfelMap::ScanId insertScan(SurfelMap& map, const PointCloud& scan_base,
                             const Eigen::Isometry3d& X_map_base,
                             const Eigen::Vector3d& p_base_sensor);

/// Way-points through the kitchen, about every half a metre: what a round trip sees.
[[nodiscard]] std::vector<Pose2> roundTrip();
/// From the start to the doorway and a little beyond.
[[nodiscard]] std::vector<Pose2> approach();

/// A scan for map making with the pose at which the map maker believes it was taken.
struct MapScan {
  PointCloud scan_base;
  Eigen::Isometry3d X_map_base = Eigen::Isometry3d::Identity();
};
/// The kitchen as it stood on another day: furniture and boxes as configured, a LiDAR with other
/// laser biases, poses off by 5 mm and 0.05 deg (sigma).
[[nodiscard]] std::vector<MapScan> mapScans(const std::vector<Pose2>& poses);
[[nodiscard]] std::shared_ptr<const SurfelMap> mapOf(const std::vector<MapScan>& scans,
                                                     const Eigen::Vector3d& p_map_center);

/// One localisation case: the kitchen on the day, the robot somewhere in it.
struct MatchCase {
  PointCloud scan;
  Eigen::Isometry3d X_map_base = Eigen::Isometry3d::Identity();  ///< truth
  Eigen::Isometry3d prior = Eigen::Isometry3d::Identity();
};
struct CaseSettings {
  double prior_m = 0.10, prior_deg = 2.0;           ///< uniform, +-
  double extrinsic_m = 0.005, extrinsic_deg = 0.3;  ///< sigma
  double tilt_deg = 0.0;                            ///< uniform, +-, of the base; the prior knows
                                                    ///< it to a quarter
  int people = 2;
  bool half_blocked = false;
  int directions = 1800;
};
/// Furniture +-15 cm and 5 deg, fire boxes +-10 cm, people 0.4 m wide about the robot, 3 % of the
/// rays lost to what nobody drew (scenario.md sections 2 and 3).
[[nodiscard]] MatchCase caseAt(const Pose2& where, const CaseSettings& settings,
                               std::uint32_t seed);
/// Anywhere inside where the robot can stand.
[[nodiscard]] Pose2 somewhereInside(std::uint32_t seed);

}  // namespace kiln::testing
