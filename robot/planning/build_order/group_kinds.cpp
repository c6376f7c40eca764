#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "robot/planning/build_order/build_time.h"

namespace kiln {
namespace {

struct Place {
  std::size_t layer = 0, index = 0;
};

/// Lays the bricks of one position after the other, always one that can lie there now.
class KindGrouping {
 public:
  KindGrouping(const LegProblem& problem, LayerRule rule) : problem_(problem), rule_(rule) {
    for (std::size_t layer = 0; layer < problem.layers.size(); ++layer) {
      stands_.emplace_back(problem.layers[layer].size(), false);
      for (std::size_t i = 0; i < problem.layers[layer].size(); ++i)
        places_[problem.layers[layer][i].slot] = {layer, i};
    }
  }

  std::vector<std::size_t> arrange(std::vector<std::size_t> slots) {
    std::vector<std::size_t> out;
    while (!slots.empty()) {
      auto next = find(slots, last_);
      if (next == slots.end()) next = find(slots, mostPlaceable(slots));
      if (next == slots.end()) return {};
      const Place place = places_.at(*next);
      stands_[place.layer][place.index] = true;
      last_ = kindAt(place);
      out.push_back(*next);
      slots.erase(next);
    }
    return out;
  }

 private:
  [[nodiscard]] BrickKind kindAt(const Place& place) const {
    return problem_.layers[place.layer][place.index].kind;
  }
  [[nodiscard]] bool fits(const Place& place) const {
    const LegBrick& brick = problem_.layers[place.layer][place.index];
    for (std::size_t i = brick.first_below; i < brick.end_below; ++i)
      if (!stands_[place.layer - 1][i]) return false;
    const auto& row = stands_[place.layer];
    const bool left = place.index > 0 && row[place.index - 1];
    if (rule_ == LayerRule::LeftToRight) return place.index == 0 || left;
    const bool right = place.index + 1 < row.size() && row[place.index + 1];
    if (left && right) return false;
    return left || right ||
           std::none_of(row.begin(), row.end(), [](bool stands) { return stands; });
  }
  /// The first brick of a kind that fits now.
  std::vector<std::size_t>::iterator find(std::vector<std::size_t>& slots,
                                          std::optional<BrickKind> kind) const {
    return std::find_if(slots.begin(), slots.end(), [&](std::size_t slot) {
      const Place place = places_.at(slot);
      return kind && kindAt(place) == *kind && fits(place);
    });
  }
  /// The kind of which most bricks fit one after the other.
  [[nodiscard]] std::optional<BrickKind> mostPlaceable(
      const std::vector<std::size_t>& slots) const {
    std::optional<BrickKind> best;
    std::size_t most = 0;
    for (const BrickShape& shape : kBrickShapes) {
      KindGrouping ahead = *this;
      std::vector<std::size_t> left = slots;
      for (auto next = ahead.find(left, shape.kind); next != left.end();
           next = ahead.find(left, shape.kind)) {
        const Place place = places_.at(*next);
        ahead.stands_[place.layer][place.index] = true;
        left.erase(next);
      }
      if (slots.size() - left.size() <= most) continue;
      most = slots.size() - left.size();
      best = shape.kind;
    }
    return best;
  }

  const LegProblem& problem_;
  LayerRule rule_;
  std::vector<std::vector<bool>> stands_;
  std::map<std::size_t, Place> places_;
  std::optional<BrickKind> last_;
};

}  // namespace

BuildOrder groupKinds(const LegProblem& problem, const BuildOrder& order, LayerRule rule) {
  KindGrouping grouping(problem, rule);
  BuildOrder grouped = order;
  for (BuildPosition& position : grouped.positions) {
    std::vector<std::size_t> slots = grouping.arrange(position.slots);
    if (slots.size() != position.slots.size()) return order;  // broke its rule before
    position.slots = std::move(slots);
  }
  return kindChanges(problem, grouped) < kindChanges(problem, order) ? grouped : order;
}

}  // namespace kiln
