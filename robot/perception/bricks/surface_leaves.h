#pragma once

#include <vector>

#include "robot/perception/bricks/brick_sweep.h"

namespace kiln {

/// Means of the points by leaves of `leaf_m`, in order of first appearance; normals unknown.
[[nodiscard]] std::vector<SurfacePoint> thin(const std::vector<Eigen::Vector3f>& points,
                                             double leaf_m);

/// Normals from the neighbours within `radius_m`, towards `sensor`; zero where they make no plane.
/// @param leaf_m  that `surface` was thinned with.
void estimateNormals(std::vector<SurfacePoint>& surface, double leaf_m, double radius_m,
                     const Eigen::Vector3f& sensor);

/// The plane with most leaves near it, by RANSAC with a fixed seed, then least squares.
/// Error{Degenerate}: none that is flat and low enough has `config.min_ground_points`.
[[nodiscard]] Result<GroundFit> fitGround(const std::vector<SurfacePoint>& leaves,
                                          const SweepPreparation& config);

}  // namespace kiln
