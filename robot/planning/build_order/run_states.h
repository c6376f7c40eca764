#pragma once

#include <vector>

#include "robot/planning/build_order/build_order.h"

namespace kiln {

/// In each layer the bricks [first, end) stand, one run; first == end: none yet.
using Runs = LayerRanges;

/// LayerRule::OneRun over runs, as PrefixStates is the paper's rule over prefixes. For one leg;
/// thread-compatible.
class RunStates {
 public:
  using State = Runs;

  /// @pre config is valid.
  RunStates(const LegProblem& problem, const BuildOrderConfig& config);

  /// Where the reach begins or ends at a brick's centre, from left to right.
  [[nodiscard]] const std::vector<double>& positions() const { return base_m_; }
  [[nodiscard]] bool isGoal(const Runs& built) const;
  /// Runs grow as far as they can, which never hinders later. But the place where a layer begins
  /// does: a state for none, one, two ... new layers begun.
  void addBuilt(std::size_t position, const Runs& built, std::vector<Runs>& out) const;
  [[nodiscard]] BuildCost remainingAtLeast(std::size_t position, const Runs& built) const;
  [[nodiscard]] bool surpasses(const Runs& a, const Runs& b) const;
  /// The slots that `after` has more than `before`, in an order in which they can be built.
  [[nodiscard]] std::vector<std::size_t> slotsBetween(const Runs& before, const Runs& after) const;

 private:
  [[nodiscard]] std::uint8_t sizeOf(std::size_t layer) const {
    return static_cast<std::uint8_t>(problem_.layers[layer].size());
  }
  /// Bricks in reach that the run below bears.
  [[nodiscard]] LayerRange buildable(std::size_t position, std::size_t layer,
                                     const Runs& built) const;

  const LegProblem& problem_;
  const BuildOrderConfig& config_;
  std::vector<double> base_m_;
  std::vector<LayerRanges> reach_;
};

}  // namespace kiln
