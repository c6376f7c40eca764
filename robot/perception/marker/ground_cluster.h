#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/geom/pose.h"

namespace kiln::marker {

/// The smallest rectangle around a set of points on the ground.
struct GroundRectangle {
  std::array<Eigen::Vector2d, 4> corners{};  ///< counter-clockwise
  double long_m = 0.0, short_m = 0.0;        ///< its sides
};

/// Points on the ground that belong together.
struct GroundCluster {
  std::vector<std::size_t> points;  ///< indices
  double area_m2 = 0.0;             ///< of the grid's cells that they fill
  GroundRectangle rectangle;
};

struct GroundClusterConfig {
  double cell_m = 0.05;
  double gap_m = 0.35;  ///< points farther apart than this from all others are another cluster's
  int min_hits = 1;     ///< points in a cell that make it count
};

/// Euclidean clustering on a grid of cells, largest area first. Points that are not finite or
/// farther than 50 m from the first one are left out.
[[nodiscard]] std::vector<GroundCluster> clusterGround(std::span<const Eigen::Vector2f> points,
                                                       const GroundClusterConfig& config);

/// The corner of an L by its rectangle: opposite to the rectangle's corner that is farthest from
/// all of the points (NimbRo UGV paper, "Wall Marker Detection").
struct LCorner {
  /// Of the wall frame (wall_layout.h). Both legs of the L are equally long, so the corner leaves
  /// one thing open, which leg is X; an L has a handedness: seen from above, one leg lies a quarter
  /// turn counter-clockwise of the other. With Z up that one is Y, and nothing else is possible.
  Pose2 X_ground_wall;
  double empty_m = 0.0;  ///< distance of the farthest corner from the nearest point
  double next_m = 0.0;   ///< the same of the corner that is second
};
/// @pre the cluster has points.
[[nodiscard]] LCorner findLCorner(const GroundCluster& cluster,
                                  std::span<const Eigen::Vector2f> points);

}  // namespace kiln::marker
