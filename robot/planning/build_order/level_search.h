#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "robot/planning/build_order/build_order.h"

namespace kiln {

/// What an order costs: so much for each position, so much for each metre between them.
struct BuildWeights {
  double position = 1.0, metre = 1.0;
  [[nodiscard]] double of(const BuildCost& cost) const {
    return position * cost.positions + metre * cost.distance_m;
  }
};

/// Searches all sequences of base positions for the cheapest; level k holds what can stand after k
/// positions. A state is dropped only where another one does at least as well, or where an
/// admissible bound says that it cannot lead to a cheaper order. `States` has
///   State                              what stands
///   positions()                        of the base, m
///   isGoal(state)
///   addBuilt(position, state, out)     all states worth having after building from there
///   remainingAtLeast(position, state)  BuildCost that no way from here to the goal undercuts
///   surpasses(a, b)                    whatever can follow `b` can follow `a`
template <class States>
class LevelSearch {
 public:
  using State = typename States::State;
  struct Step {
    std::size_t position = 0;
    State state{};  ///< after it
  };

  /// @param incumbent  cost of an order that is known already.
  LevelSearch(const States& states, BuildWeights weights, double incumbent, std::size_t most_states)
      : states_(states), weights_(weights), most_states_(most_states), best_(incumbent) {}

  /// The steps of an order cheaper than the incumbent; empty: there is none, or the search came to
  /// its end before.
  std::vector<Step> run() {
    levels_.emplace_back();
    for (std::size_t p = 0; p < states_.positions().size(); ++p)
      addChildren(State{}, p, -1, 0.0, levels_.front());
    tidy(levels_.front());
    while (!levels_.back().empty() && !given_up_) expandLast();
    return solution_;
  }
  /// No order can cost less.
  [[nodiscard]] double lowerBound() const { return given_up_ ? open_ : best_; }
  [[nodiscard]] bool proven() const { return open_ >= best_ - kRounding || !given_up_; }
  [[nodiscard]] std::size_t expanded() const { return count_; }

 private:
  static constexpr double kRounding = 1e-9;
  struct Node {
    State state{};
    std::size_t position = 0;
    double distance_m = 0.0;
    std::ptrdiff_t parent = -1;  ///< in the level before
  };
  using Level = std::vector<Node>;

  void addChildren(const State& before, std::size_t position, std::ptrdiff_t parent,
                   double distance_m, Level& level) {
    built_.clear();
    states_.addBuilt(position, before, built_);
    for (const State& state : built_) {
      const Node node{state, position, distance_m, parent};
      if (!states_.isGoal(state)) {
        level.push_back(node);
        continue;
      }
      const double cost = weights_.of({static_cast<int>(levels_.size()), distance_m});
      if (cost >= best_ - kRounding) continue;
      best_ = cost;
      solution_ = stepsTo(node);
    }
  }
  void expandLast() {
    levels_.emplace_back();
    Level& next = levels_.back();
    const Level& level = levels_[levels_.size() - 2];
    for (std::size_t i = 0; i < level.size(); ++i) {
      if (total(level[i], levels_.size() - 1) >= best_ - kRounding) continue;
      if (++count_ > most_states_) return giveUp(level, i, next);
      const double here_m = states_.positions()[level[i].position];
      for (std::size_t p = 0; p < states_.positions().size(); ++p)
        addChildren(level[i].state, p, static_cast<std::ptrdiff_t>(i),
                    level[i].distance_m + std::abs(states_.positions()[p] - here_m), next);
    }
    tidy(next);
  }
  /// What any order through this state costs at least.
  [[nodiscard]] double total(const Node& node, std::size_t positions) const {
    const BuildCost rest = states_.remainingAtLeast(node.position, node.state);
    return weights_.of(
        {static_cast<int>(positions) + rest.positions, node.distance_m + rest.distance_m});
  }
  void tidy(Level& level) {
    std::sort(level.begin(), level.end(),
              [](const Node& a, const Node& b) { return a.distance_m < b.distance_m; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < level.size(); ++i) {
      if (isSurpassed(level, kept, level[i])) continue;
      if (total(level[i], levels_.size()) >= best_ - kRounding) continue;
      level[kept++] = level[i];
    }
    level.resize(kept);
  }
  /// One of the first `kept` nodes could go to this one's position first, at no greater cost.
  [[nodiscard]] bool isSurpassed(const Level& level, std::size_t kept, const Node& node) const {
    const double here_m = states_.positions()[node.position];
    for (std::size_t i = 0; i < kept; ++i) {
      const double way_m = std::abs(states_.positions()[level[i].position] - here_m);
      if (level[i].distance_m + way_m <= node.distance_m + kRounding &&
          states_.surpasses(level[i].state, node.state))
        return true;
    }
    return false;
  }
  void giveUp(const Level& level, std::size_t from, const Level& next) {
    given_up_ = true;
    open_ = best_;
    for (std::size_t i = from; i < level.size(); ++i)
      open_ = std::min(open_, total(level[i], levels_.size() - 1));
    for (const Node& node : next) open_ = std::min(open_, total(node, levels_.size()));
  }
  [[nodiscard]] std::vector<Step> stepsTo(const Node& last) const {
    std::vector<Step> steps{{last.position, last.state}};
    std::ptrdiff_t parent = last.parent;
    for (std::size_t level = levels_.size() - 1; parent >= 0; --level) {
      const Node& node = levels_[level - 1][static_cast<std::size_t>(parent)];
      steps.push_back({node.position, node.state});
      parent = node.parent;
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

  const States& states_;
  BuildWeights weights_;
  std::size_t most_states_;
  double best_, open_ = 0.0;
  std::vector<Level> levels_;
  std::vector<State> built_;
  std::vector<Step> solution_;
  bool given_up_ = false;
  std::size_t count_ = 0;
};

}  // namespace kiln
