#pragma once

#include <array>
#include <vector>

#include "robot/planning/build_order/build_order.h"

namespace kiln {

/// Where the base may stand so that its reach begins at a brick's centre (the paper's P), and with
/// `ends` also where it ends at one. From left to right, without doubles, within the limits.
[[nodiscard]] std::vector<double> basePositions(const LegProblem& problem,
                                                const BuildOrderConfig& config, bool ends);

[[nodiscard]] LayerRanges bricksInReach(const LegProblem& problem, const BuildOrderConfig& config,
                                        double base_m);

/// Every brick is in reach from one of basePositions(). With it an order exists: of each layer the next brick
/// can be built once the layers below stand. Error: the brick that is not.
[[nodiscard]] Result<void> checkReach(const LegProblem& problem, const BuildOrderConfig& config,
                                      bool ends);

/// The centres of bricks that are still to be built; what they need at least. No allocation: asked
/// for each state of a search.
class RemainingCentres {
 public:
  /// Bricks [first, end) of a layer. At most two pieces a layer.
  void add(const std::vector<LegBrick>& bricks, std::size_t first, std::size_t end);
  /// Positions: as many windows as cover all centres, each begun at the leftmost one that is left.
  /// Way: from `base_m` to where both the leftmost and the rightmost have been in reach.
  /// @pre something was added.
  [[nodiscard]] BuildCost leastFrom(double base_m, const BuildOrderConfig& config) const;

 private:
  struct Piece {
    const LegBrick* next = nullptr;
    const LegBrick* end = nullptr;
  };
  std::array<Piece, 2 * kWallLayers> pieces_{};
  std::size_t count_ = 0;
};

}  // namespace kiln
