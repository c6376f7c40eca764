#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "robot/planning/build_order/build_order.h"

namespace kiln {

/// How many bricks of each layer stand, from the left; a word long, so that two are compared at
/// once.
using Prefix = std::array<std::uint8_t, sizeof(std::uint64_t)>;
static_assert(kWallLayers <= sizeof(std::uint64_t) && kMostLayerBricks < 0x80);

/// In each layer at least as much stands in `a` as in `b`.
[[nodiscard]] inline bool includes(const Prefix& a, const Prefix& b) {
  constexpr std::uint64_t kBorrow = 0x8080808080808080U;  // survives in a byte where a >= b
  return (((std::bit_cast<std::uint64_t>(a) | kBorrow) - std::bit_cast<std::uint64_t>(b)) &
          kBorrow) == kBorrow;
}

/// The paper's rules over prefixes: what a position adds, and what is left at least. For one leg;
/// thread-compatible.
class PrefixStates {
 public:
  using State = Prefix;
  /// @pre config is valid.
  PrefixStates(const LegProblem& problem, const BuildOrderConfig& config);

  /// Positions of the base, from left to right, without doubles.
  [[nodiscard]] const std::vector<double>& positions() const { return base_m_; }
  [[nodiscard]] const Prefix& goal() const { return goal_; }
  [[nodiscard]] bool isGoal(const Prefix& built) const { return built == goal_; }
  [[nodiscard]] bool surpasses(const Prefix& a, const Prefix& b) const { return includes(a, b); }
  /// Appends buildFrom() where it is more than what stands.
  void addBuilt(std::size_t position, const Prefix& built, std::vector<Prefix>& out) const {
    const Prefix after = buildFrom(position, built);
    if (after != built) out.push_back(after);
  }
  /// Everything built that can be from there. What is built now never hinders later, so that
  /// nothing is left for later.
  [[nodiscard]] Prefix buildFrom(std::size_t position, Prefix built) const;
  /// No way from here needs less than this. @pre built is not the goal.
  [[nodiscard]] BuildCost remainingAtLeast(std::size_t position, const Prefix& built) const;
  /// The slots that `after` has more than `before`, in an order in which they can be built.
  [[nodiscard]] std::vector<std::size_t> slotsBetween(const Prefix& before,
                                                      const Prefix& after) const;

 private:
  const LegProblem& problem_;
  const BuildOrderConfig& config_;
  std::vector<double> base_m_;
  std::vector<LayerRanges> reach_;  ///< of each position
  Prefix goal_{};
  /// Bricks of a layer that are borne when so many of the layer below stand.
  std::array<std::array<std::uint8_t, kMostLayerBricks + 1>, kWallLayers> borne_{};
};

/// What is built at each of these positions, one after the other.
[[nodiscard]] std::vector<BuildPosition> followPositions(const PrefixStates& states,
                                                         const std::vector<std::size_t>& positions);

}  // namespace kiln
