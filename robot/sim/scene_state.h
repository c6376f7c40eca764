#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln::sim {

inline constexpr std::size_t kMaxPeople = 8;

struct MovedBox {
  std::size_t box = 0;  ///< index in TrueArena::boxes
  Eigen::Isometry3d X_map_box = Eigen::Isometry3d::Identity();
};

/// Everything a sensor needs to know of one instant: copied once, then read by any thread.
struct SceneState {
  Stamp stamp;
  Eigen::Isometry3d X_map_base = Eigen::Isometry3d::Identity();
  Vector6d q = Vector6d::Zero();
  std::array<double, 4> steer_rad{}, drive_rad{};
  double plate_c = 25.0;                    ///< of the burning place
  std::vector<Eigen::Vector3d> drops;       ///< water in flight, map
  std::optional<Eigen::Vector3d> obstacle;  ///< scripted box in the arm's way
  std::optional<MovedBox> moved;
  std::vector<Eigen::Vector3d> people;      ///< their feet, map
  std::vector<Eigen::Isometry3d> bricks;    ///< as TrueWall::bricks, map
  std::vector<double> compartments_m;       ///< of the storage, along their travel
  std::optional<double> board_azimuth_rad;  ///< boards about that azimuth of the LiDAR
};

}  // namespace kiln::sim
