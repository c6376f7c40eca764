#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln::sim {

/// Everything a sensor needs to know of one instant: copied once, then read by any thread.
struct SceneState {
  Stamp stamp;
  Eigen::Isometry3d X_map_base = Eigen::Isometry3d::Identity();
  Vector6d q = Vector6d::Zero();
  std::array<double, 4> steer_rad{}, drive_rad{};
  double plate_c = 25.0;                    ///< of the burning place
  std::vector<Eigen::Vector3d> drops;       ///< water in flight, map
  std::optional<Eigen::Vector3d> obstacle;  ///< scripted box before the arm
};

}  // namespace kiln::sim
