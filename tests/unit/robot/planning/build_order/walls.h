#pragma once

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "robot/planning/build_order/leg_problem.h"
#include "robot/scene/blueprint.h"

namespace kiln::testing {

inline LegProblem problemOf(const Blueprint& wall, WallLeg leg = WallLeg::Mixed) {
  auto problem = makeLegProblem(wallSlots(wall), leg);
  EXPECT_TRUE(problem.has_value()) << problem.error();
  return problem.value_or(LegProblem{});
}

/// A wall of layers of the same bricks in random orders.
inline Blueprint smallWall(unsigned seed, std::size_t layers, std::vector<BrickKind> row) {
  std::mt19937 random(seed);
  Blueprint wall;
  wall.orange_leg = false;
  for (std::size_t layer = 0; layer < layers; ++layer) {
    for (std::size_t i = row.size() - 1; i > 0; --i) std::swap(row[i], row[random() % (i + 1)]);
    wall.layers.push_back(row);
  }
  return wall;
}

}  // namespace kiln::testing
