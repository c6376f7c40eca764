#include "robot/planning/build_order/run_states.h"

#include <algorithm>
#include <limits>

#include "robot/planning/build_order/base_positions.h"

namespace kiln {

RunStates::RunStates(const LegProblem& problem, const BuildOrderConfig& config)
    : problem_(problem), config_(config), base_m_(basePositions(problem, config, true)) {
  for (const double base : base_m_) reach_.push_back(bricksInReach(problem, config, base));
}

bool RunStates::isGoal(const Runs& built) const {
  for (std::size_t layer = 0; layer < problem_.layers.size(); ++layer)
    if (built[layer].first != 0 || built[layer].end != sizeOf(layer)) return false;
  return true;
}

LayerRange RunStates::buildable(std::size_t position, std::size_t layer, const Runs& built) const {
  LayerRange range = reach_[position][layer];
  if (layer == 0) return range;
  const auto& bricks = problem_.layers[layer];
  const LayerRange below = built[layer - 1];
  while (range.first < range.end && bricks[range.first].first_below < below.first) ++range.first;
  while (range.first < range.end && bricks[range.end - 1U].end_below > below.end) --range.end;
  return range;
}

void RunStates::addBuilt(std::size_t position, const Runs& built, std::vector<Runs>& out) const {
  const std::size_t from = out.size();
  for (std::size_t starts = 0; starts <= problem_.layers.size(); ++starts) {
    Runs after = built;
    std::size_t started = 0;
    for (std::size_t layer = 0; layer < problem_.layers.size(); ++layer) {
      const LayerRange more = buildable(position, layer, after);
      LayerRange& run = after[layer];
      if (more.first == more.end) continue;
      if (run.first == run.end) {
        if (started++ == starts) break;
        run = more;
      } else if (more.first <= run.end && more.end >= run.first) {
        run = {std::min(run.first, more.first), std::max(run.end, more.end)};
      }
    }
    if (after != built && (out.size() == from || out.back() != after)) out.push_back(after);
    if (started <= starts) break;  // there was nothing more to begin
  }
}

bool RunStates::surpasses(const Runs& a, const Runs& b) const {
  for (std::size_t layer = 0; layer < problem_.layers.size(); ++layer) {
    const bool complete = a[layer].first == 0 && a[layer].end == sizeOf(layer);
    if (complete) continue;
    const bool a_begun = a[layer].first < a[layer].end, b_begun = b[layer].first < b[layer].end;
    if (a_begun != b_begun) return false;
    if (a_begun && (a[layer].first > b[layer].first || a[layer].end < b[layer].end)) return false;
  }
  return true;
}

BuildCost RunStates::remainingAtLeast(std::size_t position, const Runs& built) const {
  RemainingCentres remaining;
  for (std::size_t layer = 0; layer < problem_.layers.size(); ++layer) {
    const bool begun = built[layer].first < built[layer].end;
    const auto& bricks = problem_.layers[layer];
    remaining.add(bricks, 0, begun ? built[layer].first : sizeOf(layer));
    if (begun) remaining.add(bricks, built[layer].end, sizeOf(layer));
  }
  return remaining.leastFrom(base_m_[position], config_);
}

std::vector<std::size_t> RunStates::slotsBetween(const Runs& before, const Runs& after) const {
  std::vector<std::size_t> slots;
  for (std::size_t layer = 0; layer < problem_.layers.size(); ++layer) {
    const auto& bricks = problem_.layers[layer];
    const bool begun = before[layer].first < before[layer].end;
    const std::uint8_t left = begun ? before[layer].first : after[layer].first;
    const std::uint8_t right = begun ? before[layer].end : after[layer].first;
    for (std::size_t i = left; i > after[layer].first; --i) slots.push_back(bricks[i - 1].slot);
    for (std::size_t i = right; i < after[layer].end; ++i) slots.push_back(bricks[i].slot);
  }
  return slots;
}

}  // namespace kiln
