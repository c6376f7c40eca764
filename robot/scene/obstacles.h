#pragma once

#include <span>
#include <string>
#include <vector>

#include "robot/scene/arena_map.h"
#include "robot/scene/brick.h"

namespace kiln {

/// Everything in the arena that a robot can run into, where it is believed to stand now: the one
/// source for driving, arm motion, jogs and routes. To be asked anew for each motion, because a
/// mission may have moved what stands elsewhere.
[[nodiscard]] std::vector<BoxConfig> obstacles(const ArenaMap& arena);

/// A brick where it is believed to lie: in a pile, in the wall, in the storage.
struct KnownBrick {
  std::string name;  ///< its own among all that stand around
  BrickKind kind = BrickKind::Red;
  Eigen::Isometry3d X_frame_brick = Eigen::Isometry3d::Identity();
};

/// The same of bricks, which come and go with each move: boxes in the frame in which they are known.
[[nodiscard]] std::vector<BoxConfig> obstacles(std::span<const KnownBrick> bricks);

}  // namespace kiln
