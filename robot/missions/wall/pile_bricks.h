#pragma once

#include <vector>

#include "robot/missions/wall/wall_belief.h"

namespace kiln {

/// The motion on the ground that takes those bricks that are trusted before and after from where they
/// were to where they are seen. Identity where there are none; a turn only where they lie far enough
/// from each other to tell one.
[[nodiscard]] Eigen::Isometry3d commonMotion(const std::vector<PileBrick>& before,
                                             const std::vector<PileBrick>& seen, double trusted);

/// What is known of the pile's bricks after one more look. The pile stands still: where the bricks
/// that are trusted before and after seem to have moved together, the robot erred on its way, and
/// all of them follow. So a long brick whose ends are not in sight from near keeps the place that
/// it was given from farther away along its length, unless it seems to lie elsewhere.
/// @param before  empty at the first look.
/// @param seen    in the same order, in `map`; Unseen and Excluded ones say nothing.
[[nodiscard]] std::vector<PileBrick> merged(const std::vector<PileBrick>& before,
                                            const std::vector<PileBrick>& seen, double trusted);

}  // namespace kiln
