#include "robot/planning/build_order/leg_problem.h"

#include <numeric>

#include "robot/scene/blueprint.h"

namespace kiln {
namespace {

constexpr double kShare_m = 0.05;  // of the joints' drift and of a true bearing
constexpr double kSlack_m = 1e-6;

LegBrick brickOf(const WallSlot& slot, std::size_t index) {
  const double center = slot.leg == WallLeg::Mixed ? slot.X_wall_brick.translation().x()
                                                   : slot.X_wall_brick.translation().y();
  const double half = brickShape(slot.kind).length_m / 2.0;
  return {index, slot.kind, center - half, center, center + half};
}

/// Finds what bears the brick. @return false: something of it hangs over.
bool findBearers(LegBrick& brick, const std::vector<LegBrick>& below) {
  const auto share = [&](const LegBrick& other) {
    return std::min(brick.right_m, other.right_m) - std::max(brick.left_m, other.left_m);
  };
  brick.first_below = 0;
  while (brick.first_below < below.size() && share(below[brick.first_below]) <= kShare_m)
    ++brick.first_below;
  brick.end_below = brick.first_below;
  double borne_to = brick.left_m;
  while (brick.end_below < below.size() && share(below[brick.end_below]) > kShare_m) {
    const LegBrick& bearer = below[brick.end_below++];
    if (bearer.left_m > borne_to + kShare_m) return false;
    borne_to = bearer.right_m;
  }
  return borne_to >= brick.right_m - kShare_m;
}

}  // namespace

std::size_t LegProblem::bricks() const {
  return std::accumulate(layers.begin(), layers.end(), std::size_t{0},
                         [](std::size_t sum, const auto& layer) { return sum + layer.size(); });
}

std::string describe(const LegProblem& problem, std::size_t layer, std::size_t index) {
  WallSlot slot;
  slot.kind = problem.layers[layer][index].kind;
  slot.layer = layer;
  slot.index = index;
  if (problem.leg == WallLeg::Orange) return describeSlot(slot);
  return fmt::format("{} (line {}, column {} of the blueprint)", describeSlot(slot),
                     problem.layers.size() - layer, 2 * index + 1);
}

Result<LegProblem> makeLegProblem(std::span<const WallSlot> slots, WallLeg leg) {
  LegProblem problem;
  problem.leg = leg;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].leg != leg) continue;
    if (slots[i].layer >= kWallLayers)
      return makeError(ErrorCode::InvalidInput, "{}: a wall has at most {} layers",
                       describeSlot(slots[i]), kWallLayers);
    if (slots[i].layer >= problem.layers.size()) problem.layers.resize(slots[i].layer + 1);
    problem.layers[slots[i].layer].push_back(brickOf(slots[i], i));
  }
  for (std::size_t layer = 0; layer < problem.layers.size(); ++layer) {
    auto& bricks = problem.layers[layer];
    if (bricks.empty() || bricks.size() > kMostLayerBricks)
      return makeError(ErrorCode::InvalidInput, "layer {} has {} bricks; 1 to {} can be planned",
                       layer + 1, bricks.size(), kMostLayerBricks);
    for (std::size_t i = 0; i < bricks.size(); ++i) {
      if (i > 0 && bricks[i].left_m < bricks[i - 1].right_m - kSlack_m)
        return makeError(ErrorCode::InvalidInput,
                         "{}: begins before its left neighbour ends; slots must not overlap",
                         describe(problem, layer, i));
      if (layer > 0 && !findBearers(bricks[i], problem.layers[layer - 1]))
        return makeError(ErrorCode::InvalidInput,
                         "{}: nothing bears all of it; the layer below must reach under it",
                         describe(problem, layer, i));
    }
  }
  return problem;
}

LayerRanges bricksWithin(const LegProblem& problem, double from_m, double to_m) {
  LayerRanges ranges{};
  for (std::size_t layer = 0; layer < problem.layers.size(); ++layer) {
    const auto& bricks = problem.layers[layer];
    std::uint8_t i = 0;
    while (i < bricks.size() && bricks[i].center_m < from_m - kSlack_m) ++i;
    ranges[layer].first = i;
    while (i < bricks.size() && bricks[i].center_m <= to_m + kSlack_m) ++i;
    ranges[layer].end = i;
  }
  return ranges;
}

}  // namespace kiln
