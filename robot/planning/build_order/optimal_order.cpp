#include "robot/planning/build_order/build_order.h"
#include "robot/planning/build_order/level_search.h"
#include "robot/planning/build_order/prefix_states.h"

namespace kiln {
namespace {

/// A position more outweighs any way: fewest positions first.
constexpr BuildWeights kPositionsFirst{1e5, 1.0};

BuildCost costFrom(double weighted) {
  const int positions = static_cast<int>(weighted / kPositionsFirst.position);
  return {positions, weighted - positions * kPositionsFirst.position};
}

}  // namespace

Result<BuildOrder> planOptimalOrder(const LegProblem& problem, const BuildOrderConfig& config) {
  auto order = planGreedyOrder(problem, config);  // the first incumbent
  if (!order) return order;
  const PrefixStates states(problem, config);
  LevelSearch search(states, kPositionsFirst, kPositionsFirst.of(order->cost),
                     static_cast<std::size_t>(config.most_states));
  const auto steps = search.run();
  if (!steps.empty()) {
    std::vector<std::size_t> positions;
    for (const auto& step : steps) positions.push_back(step.position);
    order->positions = followPositions(states, positions);
    order->cost = costOf(order->positions);
  }
  order->lower_bound = costFrom(search.lowerBound());
  order->optimal_proven = search.proven() && !cheaper(order->lower_bound, order->cost);
  order->states = search.expanded();
  return order;
}

}  // namespace kiln
