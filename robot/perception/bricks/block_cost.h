#pragma once

#include "robot/perception/bricks/brick_blocks.h"

namespace ceres {
class CostFunction;
}

namespace kiln {

/// A block as a term of a ceres::Problem over one UprightMotion; the problem owns it, the block
/// outlives it.
[[nodiscard]] ceres::CostFunction* newBlockCost(const BrickBlock& block);

}  // namespace kiln
