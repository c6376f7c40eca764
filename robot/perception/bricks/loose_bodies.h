#pragma once

#include <span>
#include <vector>

#include "robot/perception/bricks/brick_sweep.h"
#include "robot/perception/bricks/model_cloud.h"

namespace kiln {

/// Something brick-sized that no brick of the model accounts for.
struct LooseBody {
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();  ///< level, of its outline; half as high as it is
  double yaw_rad = 0.0;         ///< of its longest horizontal axis
  double length_m = 0.0, width_m = 0.0, height_m = 0.0;
  int points = 0;
};

/// Clusters of the measured points that belong to no brick and lie near none.
/// @param owners  by measured point: index of a brick, -1: none.
/// @param bricks  those that are there.
[[nodiscard]] std::vector<LooseBody> looseBodies(const PreparedSweep& sweep,
                                                 std::span<const int> owners,
                                                 std::span<const ModelBrick> bricks);

/// Whether a body may be a brick of this kind that lies somehow.
[[nodiscard]] bool mayBe(const LooseBody& body, BrickKind kind);

}  // namespace kiln
