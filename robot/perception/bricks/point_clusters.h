#pragma once

#include <vector>

#include "robot/perception/bricks/brick_sweep.h"

namespace kiln {

/// Euclidean clusters: points that are joined by steps of at most about `gap_m` (cells of that size
/// touch). In order of their first point. @return indices by cluster.
[[nodiscard]] std::vector<std::vector<std::size_t>> clusterPoints(
    const std::vector<Eigen::Vector3f>& points, double gap_m);

/// Extent of points along their principal horizontal axes.
struct GroundOutline {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< middle of the extent
  double yaw_rad = 0.0;                              ///< of the longer axis, (-pi/2, pi/2]
  double length_m = 0.0, width_m = 0.0;
  double low_m = 0.0, high_m = 0.0;                   ///< of z
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();  ///< covariance of the points in the plane
};
/// By principal component analysis. @pre points are not empty
[[nodiscard]] GroundOutline outlineOf(const std::vector<Eigen::Vector3f>& points);

}  // namespace kiln
