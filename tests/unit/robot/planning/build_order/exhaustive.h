#pragma once

#include <set>

#include "robot/planning/build_order/build_order.h"

namespace kiln::testing {

/// The rules once more, brick by brick from what stands, with no prefix, bound or dominance.
class ExhaustiveWall {
 public:
  using Standing = std::set<std::size_t>;  ///< slots

  ExhaustiveWall(const LegProblem& problem, const BuildOrderConfig& config)
      : problem_(problem), config_(config) {
    for (const auto& layer : problem.layers)
      for (const LegBrick& brick : layer) positions_.insert(brick.center_m + config.reach_shift_m);
  }

  /// Least cost over all sequences of positions of the paper's P with at most `most` of them, by
  /// trying every one (the paper's backtracking). {0, 0}: there is none.
  [[nodiscard]] BuildCost best(int most) const {
    BuildCost found;
    descend({}, {}, most, found);
    return found;
  }
  [[nodiscard]] Standing buildFrom(double base_m, Standing standing) const {
    for (bool more = true; more;) {
      more = false;
      for (std::size_t layer = 0; layer < problem_.layers.size(); ++layer)
        for (std::size_t i = 0; i < problem_.layers[layer].size(); ++i)
          more |= fits(layer, i, base_m, standing) &&
                  standing.insert(problem_.layers[layer][i].slot).second;
    }
    return standing;
  }
  [[nodiscard]] const std::set<double>& positions() const { return positions_; }

 private:
  [[nodiscard]] bool fits(std::size_t layer, std::size_t i, double base_m,
                          const Standing& standing) const {
    const LegBrick& brick = problem_.layers[layer][i];
    const double from = base_m - config_.reach_shift_m;
    if (brick.center_m < from - 1e-6 || brick.center_m > from + config_.reach_window_m + 1e-6)
      return false;
    if (i > 0 && !standing.contains(problem_.layers[layer][i - 1].slot)) return false;
    if (layer == 0) return true;
    for (const LegBrick& below : problem_.layers[layer - 1]) {
      const double shared =
          std::min(brick.right_m, below.right_m) - std::max(brick.left_m, below.left_m);
      if (shared > 0.1 && !standing.contains(below.slot)) return false;
    }
    return true;
  }
  void descend(const Standing& standing, const std::vector<double>& way, int left,
               BuildCost& found) const {
    if (standing.size() == problem_.bricks()) {
      std::vector<BuildPosition> positions;
      for (const double base : way) positions.push_back({base, {}});
      const BuildCost cost = costOf(positions);
      if (found.positions == 0 || cheaper(cost, found)) found = cost;
      return;
    }
    if (left == 0) return;
    for (const double base : positions_) {
      const Standing after = buildFrom(base, standing);
      if (after.size() == standing.size()) continue;
      std::vector<double> longer = way;
      longer.push_back(base);
      descend(after, longer, left - 1, found);
    }
  }

  const LegProblem& problem_;
  const BuildOrderConfig& config_;
  std::set<double> positions_;
};

}  // namespace kiln::testing
