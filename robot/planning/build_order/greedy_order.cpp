#include <cmath>

#include "robot/planning/build_order/base_positions.h"
#include "robot/planning/build_order/build_order.h"
#include "robot/planning/build_order/prefix_states.h"

namespace kiln {
namespace {

int countOf(const Prefix& built) {
  int bricks = 0;
  for (const std::uint8_t layer : built) bricks += layer;
  return bricks;
}

/// The position from which most bricks can be built; of several the nearest, then the leftmost.
std::size_t bestFrom(const PrefixStates& states, const Prefix& built, const double* here_m) {
  std::size_t best = 0;
  int most = -1;
  double nearest_m = 0.0;
  for (std::size_t p = 0; p < states.positions().size(); ++p) {
    const int bricks = countOf(states.buildFrom(p, built));
    const double way_m = here_m == nullptr ? 0.0 : std::abs(states.positions()[p] - *here_m);
    if (bricks < most || (bricks == most && way_m >= nearest_m)) continue;
    best = p;
    most = bricks;
    nearest_m = way_m;
  }
  return best;
}

}  // namespace

Result<BuildOrder> planGreedyOrder(const LegProblem& problem, const BuildOrderConfig& config) {
  if (auto valid = config.validate(); !valid) return tl::make_unexpected(valid.error());
  if (auto reached = checkReach(problem, config, false); !reached)
    return tl::make_unexpected(reached.error());
  const PrefixStates states(problem, config);
  std::vector<std::size_t> positions;
  Prefix built{};
  while (built != states.goal()) {
    const double* here_m = positions.empty() ? nullptr : &states.positions()[positions.back()];
    positions.push_back(bestFrom(states, built, here_m));
    built = states.buildFrom(positions.back(), built);
  }
  BuildOrder order;
  order.leg = problem.leg;
  order.positions = followPositions(states, positions);
  order.cost = costOf(order.positions);
  return order;
}

}  // namespace kiln
