#pragma once

#include <array>

#include "robot/perception/bricks/brick_correspondences.h"

namespace kiln {

/// A brick fitted in all six degrees of freedom.
struct FreeFit {
  Eigen::Isometry3d X_level_brick = Eigen::Isometry3d::Identity();
  double tilt_rad = 0.0;        ///< of its Z against upright
  double tilt_sigma_rad = 0.0;  ///< along the worse of the two axes that were seen to matter
  double weight = 0.0;          ///< of the points that it rests on
};

/// Fits one brick freely to the points around it, starting where the upright fit ended.
/// @param sigma_m  of one point.
[[nodiscard]] FreeFit fitFreely(const PreparedSweep& sweep, const ModelBrick& brick,
                                const std::array<FaceGrid, 6>& lattice, double sigma_m);

}  // namespace kiln
