#pragma once

#include <string>
#include <vector>

#include "robot/scene/ground_profile.h"
#include "robot/scene/wall_layout.h"
#include "robot/scene/wall_site_map.h"
#include "robot/sim/wall_config.h"

namespace kiln::sim {

struct SolidBox;

/// A brick as it truly is. Frame: brick.h, with its own size.
struct TrueBrick {
  std::string name;  ///< "red 3"
  BrickKind kind = BrickKind::Red;
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
  double mass_kg = 1.0;
  std::vector<Eigen::AlignedBox2d> plates;  ///< on the upper side, x and y of the brick
  Eigen::Isometry3d X_map_brick = Eigen::Isometry3d::Identity();  ///< at the beginning
};

/// Site of the wall as drawn for one seed (scenario.md section 4); without bricks it is not there.
struct TrueWall {
  Pose2 X_map_pile, X_map_wall;  ///< the pile; the marker's L
  double ground_z_m = 0.0;       ///< at the marker
  std::vector<TrueBrick> bricks;
  std::vector<WallSlot> slots;  ///< that count for the score
  [[nodiscard]] bool present() const { return !bricks.empty(); }
  [[nodiscard]] Eigen::Isometry3d markerInMap() const;

  [[nodiscard]] static Result<TrueWall> draw(const WallConfig& config, const WallSiteMap& site,
                                             const GroundProfile& ground, double size_m,
                                             std::uint64_t seed);
  /// What lies about it that nobody builds with: the marker's faces and the aerial robots' bricks.
  [[nodiscard]] std::vector<SolidBox> scenery(const WallConfig& config,
                                              const GroundProfile& ground) const;
};

}  // namespace kiln::sim
