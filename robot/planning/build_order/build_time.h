#pragma once

#include <span>

#include "robot/planning/build_order/build_order.h"

namespace kiln {

/// What building takes. Defaults: the arm as in the paper's lab test (3:06 min for 11 bricks at the
/// wall), the rest estimated; to be measured.
struct BuildTimeConfig {
  double red_s = 17.0, green_s = 17.0, blue_s = 17.0, orange_s = 17.0;  ///< storage to wall, each
  double look_s = 6.0;       ///< sweep of the wall and its evaluation, at each position
  double base_move_s = 4.0;  ///< fold, start, stop and settle, each move of the base
  double base_speed_mps = 0.3;
  /// When a brick of another kind follows: 0 with a compartment for each kind; with one for all it
  /// must travel.
  double kind_change_s = 0.0;
  void visit(ConfigArchive& a);
  [[nodiscard]] Result<void> validate() const;
  [[nodiscard]] double armTime(BrickKind kind) const;
};

/// Expected time of an order, from the first position on.
[[nodiscard]] double expectedTime(const LegProblem& problem, const BuildOrder& order,
                                  const BuildTimeConfig& time);

/// The order of least expected time, with two freedoms that the paper's rules do not have:
/// - The base may also stand where its reach *ends* at a brick's centre. With that every way that
///   is shortest among all positions of the base is among those searched.
/// - A layer may begin anywhere on what bears it and grow to both sides (LayerRule::OneRun), so that
///   the robot can build on its way back. A brick never goes between two built ones: with joints of
///   3 mm it would be lowered into a gap of its length + 6 mm, but its neighbours were placed to
///   about 5 mm each and bricks differ by 2 mm, so that about one gap in five is too short.
/// Base and arm: least of all such orders, proven as in planOptimalOrder(). Afterwards bricks of one
/// kind are drawn together at each position, as far as the rules allow it (groupKinds()); that is
/// not searched together with the positions.
/// `lower_bound` is the cost where that is proven, else nothing.
/// Errors: as planOptimalOrder().
[[nodiscard]] Result<BuildOrder> planFastestOrder(const LegProblem& problem,
                                                  const BuildOrderConfig& config,
                                                  const BuildTimeConfig& time);

/// The same positions with the same bricks at each, in an order with few changes of kind. Stays
/// within the rule.
/// @pre the order passes checkBuildOrder() with this rule.
[[nodiscard]] BuildOrder groupKinds(const LegProblem& problem, const BuildOrder& order,
                                    LayerRule rule);

[[nodiscard]] int kindChanges(const LegProblem& problem, const BuildOrder& order);

}  // namespace kiln
