#include "robot/planning/build_order/build_order.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace kiln {
namespace {

constexpr double kSame_m = 1e-6;

struct Place {
  std::size_t layer = 0, index = 0;
};

/// The wall as it grows, brick by brick.
class GrowingLeg {
 public:
  GrowingLeg(const LegProblem& problem, const BuildOrderConfig& config, LayerRule rule)
      : problem_(problem), config_(config), rule_(rule) {
    for (std::size_t layer = 0; layer < problem.layers.size(); ++layer) {
      stands_.emplace_back(problem.layers[layer].size(), false);
      for (std::size_t i = 0; i < problem.layers[layer].size(); ++i)
        places_[problem.layers[layer][i].slot] = {layer, i};
    }
  }

  Result<void> add(std::size_t slot, double base_m) {
    const auto found = places_.find(slot);
    if (found == places_.end())
      return makeError(ErrorCode::InvalidInput, "slot {} is none of this leg", slot);
    const Place place = found->second;
    if (const std::string fault = whyNot(place, base_m); !fault.empty())
      return makeError(ErrorCode::InvalidInput, "{}: {}",
                       describe(problem_, place.layer, place.index), fault);
    stands_[place.layer][place.index] = true;
    return {};
  }
  /// The first brick that does not stand.
  [[nodiscard]] std::optional<Place> missing() const {
    for (std::size_t layer = 0; layer < stands_.size(); ++layer)
      for (std::size_t i = 0; i < stands_[layer].size(); ++i)
        if (!stands_[layer][i]) return Place{layer, i};
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::string whyNot(const Place& place, double base_m) const {
    const LegBrick& brick = problem_.layers[place.layer][place.index];
    if (stands_[place.layer][place.index]) return "built twice";
    const double from = base_m - config_.reach_shift_m - kSame_m;
    if (brick.center_m < from || brick.center_m > from + config_.reach_window_m + 3.0 * kSame_m)
      return fmt::format("out of reach from {:.3f} m", base_m);
    for (std::size_t i = brick.first_below; i < brick.end_below; ++i)
      if (!stands_[place.layer - 1][i])
        return fmt::format("not supported: {} is not built yet",
                           describe(problem_, place.layer - 1, i));
    return neighbourFault(stands_[place.layer], place.index);
  }
  [[nodiscard]] std::string neighbourFault(const std::vector<bool>& row, std::size_t i) const {
    const bool left = i > 0 && row[i - 1], right = i + 1 < row.size() && row[i + 1];
    if (rule_ == LayerRule::LeftToRight)
      return i == 0 || left ? "" : "its left neighbour is not built yet";
    if (left && right) return "would have to go between two built neighbours";
    const bool first = std::none_of(row.begin(), row.end(), [](bool stands) { return stands; });
    return first || left || right ? "" : "a second run of its layer";
  }

  const LegProblem& problem_;
  const BuildOrderConfig& config_;
  LayerRule rule_;
  std::vector<std::vector<bool>> stands_;
  std::map<std::size_t, Place> places_;
};

}  // namespace

void BuildOrderConfig::visit(ConfigArchive& a) {
  a.field("reach_shift_m", reach_shift_m, "m", 0.0, 2.0,
          "the base stands this far right of the leftmost brick in reach");
  a.field("reach_window_m", reach_window_m, "m", 0.0, 4.0,
          "length of the wall whose bricks are in reach from one position");
  a.field("base_min_m", base_min_m, "m", -1e3, 1e3,
          "the base may stand from here on along the leg");
  a.field("base_max_m", base_max_m, "m", -1e3, 1e3, "the base may stand up to here along the leg");
  a.field("most_states", most_states, "", 1, 100'000'000, "end a search, unproven, after so many");
}

Result<void> BuildOrderConfig::validate() const {
  const bool numbers = reach_shift_m >= 0.0 && reach_window_m >= 0.0 && base_min_m <= base_max_m &&
                       std::isfinite(reach_shift_m + reach_window_m + base_min_m + base_max_m);
  if (!numbers || most_states < 1)
    return makeError(ErrorCode::InvalidInput,
                     "build order: reach_shift_m, reach_window_m and most_states must not be "
                     "negative, base_min_m not above base_max_m");
  return {};
}

bool cheaper(const BuildCost& a, const BuildCost& b) {
  if (a.positions != b.positions) return a.positions < b.positions;
  return a.distance_m < b.distance_m - kSame_m;
}

BuildCost costOf(const std::vector<BuildPosition>& positions) {
  BuildCost cost;
  cost.positions = static_cast<int>(positions.size());
  for (std::size_t i = 1; i < positions.size(); ++i)
    cost.distance_m += std::abs(positions[i].base_m - positions[i - 1].base_m);
  return cost;
}

Result<void> checkBuildOrder(const LegProblem& problem, const BuildOrderConfig& config,
                             const BuildOrder& order, LayerRule rule) {
  GrowingLeg leg(problem, config, rule);
  for (const BuildPosition& position : order.positions) {
    if (!(position.base_m >= config.base_min_m && position.base_m <= config.base_max_m))
      return makeError(ErrorCode::InvalidInput,
                       "position {:.2f} m: the base may stand from {:.2f} to {:.2f} m",
                       position.base_m, config.base_min_m, config.base_max_m);
    for (const std::size_t slot : position.slots)
      if (auto added = leg.add(slot, position.base_m); !added) return added;
  }
  if (const auto place = leg.missing())
    return makeError(ErrorCode::InvalidInput, "{}: never built",
                     describe(problem, place->layer, place->index));
  const BuildCost cost = costOf(order.positions);
  if (cheaper(cost, order.cost) || cheaper(order.cost, cost))
    return makeError(
        ErrorCode::InvalidInput,
        "the order is said to need {} positions and {:.3f} m; it needs {} and {:.3f} m",
        order.cost.positions, order.cost.distance_m, cost.positions, cost.distance_m);
  return {};
}

}  // namespace kiln
