#pragma once

#include <optional>
#include <span>

#include "common/config/config_archive.h"
#include "common/geom/pose.h"
#include "robot/planning/base_path/base_path.h"

namespace kiln {

struct CorridorConfig {
  double look_ahead_m = 2.0;  ///< along the path
  double margin_m = 0.06;     ///< beside the footprint
  double step_m = 0.05;       ///< between two poses that are looked at
  int min_points = 4;         ///< fewer are noise
  double gather_m = 0.30;     ///< points count together within this
  void visit(ConfigArchive& a);
};

/// Something stands where the base would drive.
struct CorridorHit {
  double distance_m = 0.0;                          ///< way that is left until it touches
  Eigen::Vector2d p_map = Eigen::Vector2d::Zero();  ///< the middle of what is in the way
  int points = 0;
};

/// The first thing that the footprint would touch on the next piece of its path. What already lies
/// within the footprint is the robot itself; what lies within the margin beside it may stay there,
/// but not come nearer.
/// @param from_s     path coordinate of the base now.
/// @param X_map_now  where it really is; the first pose that is looked at.
/// @param points_map obstacles on the ground plane of map, the ground itself removed.
[[nodiscard]] std::optional<CorridorHit> firstInCorridor(
    const BasePath& path, double from_s, const Pose2& X_map_now, double length_m, double width_m,
    std::span<const Eigen::Vector2d> points_map, const CorridorConfig& config);

}  // namespace kiln
