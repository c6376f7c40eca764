#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/core/error.h"
#include "robot/scene/wall_layout.h"

namespace kiln {

/// One brick of a leg as the planners see it; lengths along the leg, in the wall frame.
struct LegBrick {
  std::size_t slot = 0;  ///< index in the slots that the problem was made of
  BrickKind kind = BrickKind::Red;
  double left_m = 0.0, center_m = 0.0, right_m = 0.0;
  std::size_t first_below = 0, end_below = 0;  ///< bricks of the layer below that bear it
};

/// A leg of the wall: layers from the ground, bricks from left to right along the leg.
struct LegProblem {
  WallLeg leg = WallLeg::Mixed;
  std::vector<std::vector<LegBrick>> layers;
  [[nodiscard]] std::size_t bricks() const;
};

inline constexpr std::size_t kMostLayerBricks = 15;

/// What the rules of building need to know of a leg. Two bricks bear on each other when they share
/// more than 5 cm: joints shift a layer by less than that, lengths differ by 30 cm.
/// @param slots  as wallSlots() gives them
/// Error: InvalidInput, with the brick that lies on nothing, or what the leg is too large for.
[[nodiscard]] Result<LegProblem> makeLegProblem(std::span<const WallSlot> slots, WallLeg leg);

/// "blue, layer 2, 4th from the left (line 4, column 7 of the blueprint)", as formatBlueprint()
/// writes it.
[[nodiscard]] std::string describe(const LegProblem& problem, std::size_t layer, std::size_t index);

/// The bricks [first, end) of each layer.
struct LayerRange {
  std::uint8_t first = 0, end = 0;
  friend bool operator==(const LayerRange&, const LayerRange&) = default;
};
using LayerRanges = std::array<LayerRange, kWallLayers>;

/// The bricks whose centres lie within [from, to] along the leg, with a micrometre to spare.
[[nodiscard]] LayerRanges bricksWithin(const LegProblem& problem, double from_m, double to_m);

}  // namespace kiln
