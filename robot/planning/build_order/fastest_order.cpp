#include <limits>

#include "robot/planning/build_order/base_positions.h"
#include "robot/planning/build_order/build_time.h"
#include "robot/planning/build_order/level_search.h"
#include "robot/planning/build_order/run_states.h"

namespace kiln {

Result<BuildOrder> planFastestOrder(const LegProblem& problem, const BuildOrderConfig& config,
                                    const BuildTimeConfig& time) {
  if (auto valid = config.validate(); !valid) return tl::make_unexpected(valid.error());
  if (auto valid = time.validate(); !valid) return tl::make_unexpected(valid.error());
  if (auto reached = checkReach(problem, config, true); !reached)
    return tl::make_unexpected(reached.error());
  const BuildWeights weights{time.look_s + time.base_move_s, 1.0 / time.base_speed_mps};
  double incumbent = std::numeric_limits<double>::infinity();
  BuildOrder order;
  order.leg = problem.leg;
  if (auto paper = planOptimalOrder(problem, config)) {  // it keeps the wider rule too
    order = *paper;
    incumbent = weights.of(order.cost);
  }
  const RunStates states(problem, config);
  LevelSearch search(states, weights, incumbent, static_cast<std::size_t>(config.most_states));
  const auto steps = search.run();
  if (!steps.empty()) {
    order.positions.clear();
    Runs built{};
    for (const auto& step : steps) {
      order.positions.push_back(
          {states.positions()[step.position], states.slotsBetween(built, step.state)});
      built = step.state;
    }
    order.cost = costOf(order.positions);
  }
  if (order.positions.empty())
    return makeError(ErrorCode::InvalidInput,
                     "no order found within {} states; allow more (most_states)",
                     config.most_states);
  order.states = search.expanded();
  order.optimal_proven = search.proven();
  order.lower_bound = order.optimal_proven ? order.cost : BuildCost{};
  return groupKinds(problem, order, LayerRule::OneRun);
}

}  // namespace kiln
