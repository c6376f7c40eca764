#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "robot/scene/brick.h"

namespace kiln {

/// Bricks of one kind on top of each other, lying along X of the pile.
struct PileStack {
  BrickKind kind = BrickKind::Red;
  int line = 1;  ///< 1: the first line, 2: behind it
  int bricks = 5;
  [[nodiscard]] double length() const { return brickShape(kind).length_m; }
};

/// One place for a brick, lying along X.
struct PileSlot {
  BrickKind kind = BrickKind::Red;
  std::size_t stack = 0;
  std::size_t layer = 0;  ///< 0 at the ground
  Eigen::Isometry3d X_pile_brick = Eigen::Isometry3d::Identity();
};

/// Where the stacks of a pile nominally stand. Pile frame: on the ground, at the beginning of line
/// 1's middle line; X along line 1 (the longest side), Y towards line 2, Z up (scenario.md section
/// 4). A line's stacks follow each other from x = 0.
struct PileLayout {
  std::vector<PileStack> stacks;
  double gap_m = 0.1;            ///< between the stacks of a line
  double line_distance_m = 2.6;  ///< between the middles of line 1 and line 2

  /// Of each stack, on the ground. @pre line is 1 or 2, bricks > 0
  [[nodiscard]] std::vector<Eigen::Vector2d> middles() const;
  /// Stack by stack in the order given, each from the ground up. @pre as middles()
  [[nodiscard]] std::vector<PileSlot> slots() const;
  /// From its first stack's beginning to its last one's end; 0: no stack.
  [[nodiscard]] double lineLength(int line) const;
  [[nodiscard]] double length() const;  ///< of the longer line
};

/// The pile of the task of 45: four stacks of red, two of green, one of blue; two of orange behind.
[[nodiscard]] PileLayout arenaPile();
/// The paper's lab test: four red, four green, three blue in one line.
[[nodiscard]] PileLayout labPile();

}  // namespace kiln
