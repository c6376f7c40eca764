#pragma once

#include <vector>

#include "robot/planning/build_order/build_order.h"
#include "robot/planning/storage/storage_plan.h"
#include "robot/scene/wall_layout.h"

namespace kiln {

struct WallConfig;
struct RobotGeometry;

/// What is carried to the wall at once and set there: one leg of it.
struct WallLoad {
  WallLeg leg = WallLeg::Mixed;
  BuildOrder order;
  std::vector<std::size_t> slots;  ///< of WallPlan, in the order in which they are filled
  StoragePlan storage;             ///< its sequence is that of `slots`
  double expected_s = 0.0;         ///< at the wall
};

/// What is to be built, and in which order: known before anything moves.
struct WallPlan {
  Blueprint blueprint;
  std::vector<WallSlot> slots;
  std::vector<WallLoad> loads;  ///< the orange leg first, where there is one (paper)
};

/// Blueprint, order of least expected time and storage, each checked by its own checker.
/// Error: InvalidInput: what is wrong with the file, the order or the storage, and where.
[[nodiscard]] Result<WallPlan> planWall(const WallConfig& config, const RobotGeometry& robot);

}  // namespace kiln
