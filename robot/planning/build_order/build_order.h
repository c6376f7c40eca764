#pragma once

#include <cstdint>
#include <vector>

#include "common/config/config_archive.h"
#include "common/core/error.h"
#include "robot/planning/build_order/leg_problem.h"

namespace kiln {

/// What one position of the base reaches, and how long a search may take.
struct BuildOrderConfig {
  /// The base stands this far to the right of the leftmost brick that it reaches (paper: t_x).
  double reach_shift_m = 0.675;
  /// Bricks whose centres lie on this length of the leg are in reach; the paper does not state it.
  double reach_window_m = 1.1;
  double base_min_m = -5.0, base_max_m = 10.0;  ///< where the base may stand, along the leg
  int most_states = 2'000'000;                  ///< a search that needs more ends unproven
  void visit(ConfigArchive& a);
  [[nodiscard]] Result<void> validate() const;
};

/// Where the base stands, along the leg in the wall frame, and which slots it fills from there, in
/// order.
struct BuildPosition {
  double base_m = 0.0;
  std::vector<std::size_t> slots;
};

/// Fewest positions first, then the shortest way between them (paper, section "Challenge 2").
struct BuildCost {
  int positions = 0;
  double distance_m = 0.0;
};
/// Distances within a micrometre are alike.
[[nodiscard]] bool cheaper(const BuildCost& a, const BuildCost& b);

[[nodiscard]] BuildCost costOf(const std::vector<BuildPosition>& positions);

struct BuildOrder {
  WallLeg leg = WallLeg::Mixed;
  std::vector<BuildPosition> positions;
  BuildCost cost;
  /// No order can be cheaper than this. The search covers every order that it does not bound.
  BuildCost lower_bound;
  bool optimal_proven = false;  ///< lower_bound is the cost
  std::size_t states = 0;       ///< states that were looked at
};

/// The paper's rules: positions P = {centre of a brick + t_x}; at each, every brick is built that
/// is in reach, lies on the ground or on built ones, and whose left neighbour is built. Built bricks
/// are a prefix of each layer, so that a state is five lengths and a position; all states are
/// searched, level by level, except those that an admissible bound excludes. A position may be
/// taken twice.
/// Error: InvalidInput with the reason, and the brick that cannot be built where it is one.
[[nodiscard]] Result<BuildOrder> planOptimalOrder(const LegProblem& problem,
                                                  const BuildOrderConfig& config);

/// The paper's greedy strategy: always the position from which most bricks can be built; of several
/// the nearest. Errors as above. Proves nothing: `lower_bound` stays empty.
[[nodiscard]] Result<BuildOrder> planGreedyOrder(const LegProblem& problem,
                                                 const BuildOrderConfig& config);

/// How the bricks of a layer may follow each other.
enum class LayerRule {
  LeftToRight,  ///< the paper's: only beside a built left neighbour
  OneRun,       ///< beside any built neighbour, or the first of its layer; never between two
};

/// Walks through an order by itself, apart from all planners: each brick once, in reach, supported,
/// beside its neighbours as the rule wants it; number of positions and way as stated.
/// Error: InvalidInput, names the brick and what it lacks.
[[nodiscard]] Result<void> checkBuildOrder(const LegProblem& problem,
                                           const BuildOrderConfig& config, const BuildOrder& order,
                                           LayerRule rule);

}  // namespace kiln
