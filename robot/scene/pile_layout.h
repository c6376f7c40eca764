#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "robot/scene/brick.h"

namespace kiln {

/// Stacks of bricks side by side. Pile frame: on the ground, at the beginning of line 1's middle
/// line; X along line 1 (the longest side), Y towards line 2, Z up (scenario.md section 4).
struct PileStack {
  BrickKind kind = BrickKind::Red;
  int line = 1;
  int bricks = 5;
};

/// One place for a brick, lying along X.
struct PileSlot {
  BrickKind kind = BrickKind::Red;
  std::size_t stack = 0;
  std::size_t layer = 0;  ///< 0 at the ground
  Eigen::Isometry3d X_pile_brick = Eigen::Isometry3d::Identity();
};

inline constexpr double kPileGap_m = 0.1;           ///< between the stacks of a line
inline constexpr double kPileLineDistance_m = 2.6;  ///< between the middles of line 1 and line 2

/// The pile of the task of 45: four stacks of red, two of green, one of blue; two of orange behind.
[[nodiscard]] std::vector<PileStack> arenaPile();
/// The paper's lab test: four red, four green, three blue in one line.
[[nodiscard]] std::vector<PileStack> labPile();

/// Where the bricks of these stacks nominally lie: stack by stack in the order given, each from the
/// ground up; a line's stacks follow each other from x = 0. @pre line is 1 or 2, bricks > 0
[[nodiscard]] std::vector<PileSlot> pileSlots(std::span<const PileStack> stacks);

/// Length of the longest line, metres.
[[nodiscard]] double pileLength(std::span<const PileStack> stacks);

}  // namespace kiln
