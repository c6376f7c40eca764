#include "robot/planning/build_order/build_time.h"

#include <array>
#include <cmath>
#include <optional>

namespace kiln {
namespace {

/// The kinds in the order of the bricks.
std::vector<BrickKind> kindsOf(const LegProblem& problem, const BuildOrder& order) {
  std::vector<BrickKind> by_slot;
  for (const auto& layer : problem.layers)
    for (const LegBrick& brick : layer) {
      if (brick.slot >= by_slot.size()) by_slot.resize(brick.slot + 1);
      by_slot[brick.slot] = brick.kind;
    }
  std::vector<BrickKind> kinds;
  for (const BuildPosition& position : order.positions)
    for (const std::size_t slot : position.slots) kinds.push_back(by_slot.at(slot));
  return kinds;
}

}  // namespace

void BuildTimeConfig::visit(ConfigArchive& a) {
  a.field("red_s", red_s, "s", 0.0, 600.0, "arm, from storage to wall, one red brick");
  a.field("green_s", green_s, "s", 0.0, 600.0, "the same, green");
  a.field("blue_s", blue_s, "s", 0.0, 600.0, "the same, blue");
  a.field("orange_s", orange_s, "s", 0.0, 600.0, "the same, orange");
  a.field("look_s", look_s, "s", 0.0, 600.0, "sweep of the wall at each position");
  a.field("base_move_s", base_move_s, "s", 0.0, 600.0, "each move of the base, however short");
  a.field("base_speed_mps", base_speed_mps, "m/s", 0.01, 4.0, "between positions");
  a.field("kind_change_s", kind_change_s, "s", 0.0, 600.0,
          "when the next brick is of another kind: the compartment travels");
}

Result<void> BuildTimeConfig::validate() const {
  double least = base_speed_mps;
  for (const double value : {red_s, green_s, blue_s, orange_s, look_s, base_move_s, kind_change_s})
    least = std::min(least, std::isfinite(value) ? value : -1.0);
  if (least < 0.0 || !std::isfinite(base_speed_mps) || base_speed_mps <= 0.0)
    return makeError(ErrorCode::InvalidInput,
                     "build time: no time may be negative, base_speed_mps must be above 0");
  return {};
}

double BuildTimeConfig::armTime(BrickKind kind) const {
  const std::array<double, kBrickKinds> times{red_s, green_s, blue_s, orange_s};
  return times[static_cast<std::size_t>(kind)];
}

int kindChanges(const LegProblem& problem, const BuildOrder& order) {
  const auto kinds = kindsOf(problem, order);
  int changes = 0;
  for (std::size_t i = 1; i < kinds.size(); ++i) changes += kinds[i] != kinds[i - 1] ? 1 : 0;
  return changes;
}

double expectedTime(const LegProblem& problem, const BuildOrder& order,
                    const BuildTimeConfig& time) {
  const BuildCost cost = costOf(order.positions);
  double sum_s = cost.positions * time.look_s + std::max(0, cost.positions - 1) * time.base_move_s +
                 cost.distance_m / time.base_speed_mps +
                 kindChanges(problem, order) * time.kind_change_s;
  for (const BrickKind kind : kindsOf(problem, order)) sum_s += time.armTime(kind);
  return sum_s;
}

}  // namespace kiln
