#include "robot/planning/storage/stacks.h"

#include <algorithm>
#include <set>

namespace kiln {
namespace {

constexpr int kMostTries = 200'000;

/// How many of one kind may stand on each other.
std::size_t capacity(BrickKind kind, std::size_t most, const StackRule& rule) {
  std::vector<BrickKind> stack;
  while (stack.size() < most) {
    stack.push_back(kind);
    if (!rule(stack).empty()) return stack.size() - 1;
  }
  return stack.size();
}

/// One kind a stack, each holding what is built next of that kind.
std::optional<std::vector<Stack>> pureStacks(std::span<const BrickKind> sequence, std::size_t bins,
                                             const StackRule& rule) {
  std::vector<Stack> stacks;
  for (const BrickShape& shape : kBrickShapes) {
    std::vector<std::size_t> bricks;
    for (std::size_t i = 0; i < sequence.size(); ++i)
      if (sequence[i] == shape.kind) bricks.push_back(i);
    const std::size_t most = capacity(shape.kind, bricks.size(), rule);
    if (!bricks.empty() && most == 0) return std::nullopt;
    for (std::size_t i = 0; i < bricks.size(); i += most) {
      const auto begin = bricks.begin() + static_cast<std::ptrdiff_t>(i);
      const auto end = begin + static_cast<std::ptrdiff_t>(std::min(most, bricks.size() - i));
      stacks.emplace_back(std::make_reverse_iterator(end), std::make_reverse_iterator(begin));
    }
  }
  if (stacks.size() > bins) return std::nullopt;
  return stacks;
}

/// Sets the bricks in from the last one built, each on any stack or on a floor.
class MixedStacks {
 public:
  MixedStacks(std::span<const BrickKind> sequence, std::size_t bins, const StackRule& rule)
      : sequence_(sequence), bins_(bins), rule_(rule) {}

  std::optional<std::vector<Stack>> find(int most_mixed) {
    failed_.clear();
    stacks_.clear();
    if (!place(sequence_.size(), most_mixed)) return std::nullopt;
    return stacks_;
  }
  [[nodiscard]] bool givenUp() const { return tries_ >= kMostTries; }

 private:
  [[nodiscard]] std::vector<BrickKind> kindsOf(const Stack& stack) const {
    std::vector<BrickKind> kinds;
    for (const std::size_t brick : stack) kinds.push_back(sequence_[brick]);
    return kinds;
  }
  /// Stacks are alike when their kinds are, whichever bins they stand in.
  [[nodiscard]] std::vector<std::vector<BrickKind>> state() const {
    std::vector<std::vector<BrickKind>> state;
    for (const Stack& stack : stacks_) state.push_back(kindsOf(stack));
    std::sort(state.begin(), state.end());
    return state;
  }
  bool place(std::size_t left, int mixed_left) {
    if (left == 0) return true;
    if (++tries_ >= kMostTries || failed_.contains(state())) return false;
    const std::size_t brick = left - 1;
    const BrickKind kind = sequence_[brick];
    std::set<std::vector<BrickKind>> tried;
    for (std::size_t i = 0; i < stacks_.size(); ++i) {
      std::vector<BrickKind> kinds = kindsOf(stacks_[i]);
      if (!tried.insert(kinds).second) continue;
      const bool pure = std::all_of(kinds.begin(), kinds.end(),
                                    [&](BrickKind other) { return other == kinds.front(); });
      const int mixes = pure && kinds.front() != kind ? 1 : 0;
      kinds.push_back(kind);
      if (mixes > mixed_left || !rule_(kinds).empty()) continue;
      stacks_[i].push_back(brick);
      if (place(brick, mixed_left - mixes)) return true;
      stacks_[i].pop_back();
    }
    if (stacks_.size() < bins_ && rule_(std::vector<BrickKind>{kind}).empty()) {
      stacks_.push_back({brick});
      if (place(brick, mixed_left)) return true;
      stacks_.pop_back();
    }
    failed_.insert(state());
    return false;
  }

  std::span<const BrickKind> sequence_;
  std::size_t bins_;
  const StackRule& rule_;
  std::vector<Stack> stacks_;
  std::set<std::vector<std::vector<BrickKind>>> failed_;
  int tries_ = 0;
};

}  // namespace

std::optional<std::vector<Stack>> divideIntoStacks(std::span<const BrickKind> sequence,
                                                   std::size_t bins, const StackRule& rule) {
  if (auto stacks = pureStacks(sequence, bins, rule)) return stacks;
  MixedStacks search(sequence, bins, rule);
  for (std::size_t mixed = 1; mixed <= bins && !search.givenUp(); ++mixed)
    if (auto stacks = search.find(static_cast<int>(mixed))) return stacks;
  return std::nullopt;
}

int mixedStacks(std::span<const BrickKind> sequence, const std::vector<Stack>& stacks) {
  return static_cast<int>(std::count_if(stacks.begin(), stacks.end(), [&](const Stack& stack) {
    return std::any_of(stack.begin(), stack.end(), [&](std::size_t brick) {
      return sequence[brick] != sequence[stack.front()];
    });
  }));
}

}  // namespace kiln
