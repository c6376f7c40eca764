#pragma once

#include <vector>

#include "robot/missions/wall/wall_belief.h"
#include "robot/perception/bricks/brick_poses.h"

namespace kiln {

/// By the covariance of the estimate: one sigma along the brick's length, m, at most 1.
[[nodiscard]] double alongSigma(const BrickEstimate& brick);

/// A motion on the ground, and how well it is known.
struct CommonMotion {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of its translation, m^2
};
/// What takes those bricks that are trusted before and after from where they were to where they are
/// seen, each by what it is seen of: along its length by its along_m. Where they tell nothing it is
/// what wheels err by on a drive, 3 cm about none; a turn only where they lie far enough from each
/// other to tell one.
[[nodiscard]] CommonMotion commonMotion(const std::vector<PileBrick>& before,
                                        const std::vector<PileBrick>& seen, double trusted);

/// What is known of the pile's bricks after one more look. The pile stands still: where the bricks
/// that are trusted before and after seem to have moved together, the robot erred on its way, and
/// all of them follow. Along its length, where a look from near shows little, the place of a brick is
/// the weighted mean of all looks; else it is as it is seen now, unless it is seen too vaguely.
/// @param before  empty at the first look.
/// @param seen    in the same order, in `map`; Unseen and Excluded ones say nothing.
/// @param stood   the robot has not driven since the look before: it cannot have erred on its way.
[[nodiscard]] std::vector<PileBrick> merged(const std::vector<PileBrick>& before,
                                            const std::vector<PileBrick>& seen, double trusted,
                                            bool stood = false);

}  // namespace kiln
