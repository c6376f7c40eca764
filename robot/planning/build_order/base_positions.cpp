#include "robot/planning/build_order/base_positions.h"

#include <algorithm>
#include <limits>

namespace kiln {
namespace {

constexpr double kSame_m = 1e-6;

/// Way from `here` by a place at or left of `left_stop` and one at or right of `right_stop`.
double leastWay(double here, double left_stop, double right_stop) {
  if (left_stop >= right_stop) return std::max({0.0, right_stop - here, here - left_stop});
  if (here <= left_stop) return right_stop - here;
  if (here >= right_stop) return here - left_stop;
  return right_stop - left_stop + std::min(here - left_stop, right_stop - here);
}

}  // namespace

std::vector<double> basePositions(const LegProblem& problem, const BuildOrderConfig& config,
                                  bool ends) {
  std::vector<double> base_m;
  const auto add = [&](double base) {
    if (base >= config.base_min_m && base <= config.base_max_m) base_m.push_back(base);
  };
  for (const auto& layer : problem.layers)
    for (const LegBrick& brick : layer) {
      add(brick.center_m + config.reach_shift_m);
      if (ends) add(brick.center_m + config.reach_shift_m - config.reach_window_m);
    }
  std::sort(base_m.begin(), base_m.end());
  const auto same = [](double a, double b) { return b - a < kSame_m; };
  base_m.erase(std::unique(base_m.begin(), base_m.end(), same), base_m.end());
  return base_m;
}

LayerRanges bricksInReach(const LegProblem& problem, const BuildOrderConfig& config,
                          double base_m) {
  const double from = base_m - config.reach_shift_m;
  return bricksWithin(problem, from, from + config.reach_window_m);
}

Result<void> checkReach(const LegProblem& problem, const BuildOrderConfig& config, bool ends) {
  std::vector<LayerRanges> reach;
  for (const double base : basePositions(problem, config, ends))
    reach.push_back(bricksInReach(problem, config, base));
  for (std::size_t layer = 0; layer < problem.layers.size(); ++layer)
    for (std::size_t i = 0; i < problem.layers[layer].size(); ++i)
      if (std::none_of(reach.begin(), reach.end(), [&](const LayerRanges& ranges) {
            return ranges[layer].first <= i && i < ranges[layer].end;
          }))
        return makeError(ErrorCode::InvalidInput,
                         "{}: out of reach from everywhere the base may stand ({:.2f} to {:.2f} m "
                         "along the leg, reach {:.2f} m); widen reach_window_m, base_min_m or "
                         "base_max_m",
                         describe(problem, layer, i), config.base_min_m, config.base_max_m,
                         config.reach_window_m);
  return {};
}

void RemainingCentres::add(const std::vector<LegBrick>& bricks, std::size_t first,
                           std::size_t end) {
  if (first < end) pieces_[count_++] = {bricks.data() + first, bricks.data() + end};
}

BuildCost RemainingCentres::leastFrom(double base_m, const BuildOrderConfig& config) const {
  std::array<Piece, 2 * kWallLayers> left = pieces_;
  double leftmost = std::numeric_limits<double>::max();
  double rightmost = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0; i < count_; ++i) {
    leftmost = std::min(leftmost, left[i].next->center_m);
    rightmost = std::max(rightmost, (left[i].end - 1)->center_m);
  }
  BuildCost least;
  for (double from = leftmost; from <= rightmost;) {
    ++least.positions;
    const double to = from + config.reach_window_m + 2.0 * kSame_m;
    from = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < count_; ++i) {
      while (left[i].next != left[i].end && left[i].next->center_m <= to) ++left[i].next;
      if (left[i].next != left[i].end) from = std::min(from, left[i].next->center_m);
    }
  }
  least.distance_m = leastWay(base_m, leftmost + config.reach_shift_m + kSame_m,
                              rightmost + config.reach_shift_m - config.reach_window_m - kSame_m);
  return least;
}

}  // namespace kiln
