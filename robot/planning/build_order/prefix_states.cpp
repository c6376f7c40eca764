#include "robot/planning/build_order/prefix_states.h"

#include <algorithm>

#include "robot/planning/build_order/base_positions.h"

namespace kiln {

PrefixStates::PrefixStates(const LegProblem& problem, const BuildOrderConfig& config)
    : problem_(problem), config_(config), base_m_(basePositions(problem, config, false)) {
  for (const double base : base_m_) reach_.push_back(bricksInReach(problem, config, base));
  for (std::size_t layer = 0; layer < problem.layers.size(); ++layer) {
    const auto& bricks = problem.layers[layer];
    goal_[layer] = static_cast<std::uint8_t>(bricks.size());
    const std::size_t below = layer == 0 ? 0 : problem.layers[layer - 1].size();
    for (std::size_t stand = 0; stand <= below; ++stand) {
      std::uint8_t& borne = borne_[layer][stand];
      while (borne < bricks.size() && (layer == 0 || bricks[borne].end_below <= stand)) ++borne;
    }
  }
}

Prefix PrefixStates::buildFrom(std::size_t position, Prefix built) const {
  const LayerRanges& reach = reach_[position];
  for (std::size_t layer = 0; layer < problem_.layers.size(); ++layer) {
    if (built[layer] < reach[layer].first) continue;
    const std::uint8_t borne = borne_[layer][layer == 0 ? 0 : built[layer - 1]];
    built[layer] = std::max(built[layer], std::min(reach[layer].end, borne));
  }
  return built;
}

BuildCost PrefixStates::remainingAtLeast(std::size_t position, const Prefix& built) const {
  RemainingCentres remaining;
  for (std::size_t layer = 0; layer < problem_.layers.size(); ++layer)
    remaining.add(problem_.layers[layer], built[layer], goal_[layer]);
  return remaining.leastFrom(base_m_[position], config_);
}

std::vector<std::size_t> PrefixStates::slotsBetween(const Prefix& before,
                                                    const Prefix& after) const {
  std::vector<std::size_t> slots;
  for (std::size_t layer = 0; layer < problem_.layers.size(); ++layer)
    for (std::size_t i = before[layer]; i < after[layer]; ++i)
      slots.push_back(problem_.layers[layer][i].slot);
  return slots;
}

std::vector<BuildPosition> followPositions(const PrefixStates& states,
                                           const std::vector<std::size_t>& positions) {
  std::vector<BuildPosition> out;
  Prefix built{};
  for (const std::size_t position : positions) {
    const Prefix after = states.buildFrom(position, built);
    out.push_back({states.positions()[position], states.slotsBetween(built, after)});
    built = after;
  }
  return out;
}

}  // namespace kiln
