#include "robot/planning/storage/storage_plan.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>

#include "robot/planning/storage/posture_sets.h"
#include "robot/planning/storage/stacks.h"

namespace kiln {
namespace {

constexpr std::size_t kNoStack = static_cast<std::size_t>(-1);
constexpr int kRestarts = 24;

struct Bin {
  std::size_t compartment = 0;
  int bin = 0;
};

std::vector<Bin> binsOf(const StorageRoom& room) {
  std::vector<Bin> bins;
  for (std::size_t c = 0; c < room.rows.size(); ++c)
    for (int bin = 0; bin < room.rows[c].bins; ++bin) bins.push_back({c, bin});
  return bins;
}

/// Which bin each stack takes, judged by the stops that unloading needs.
class BinChoice {
 public:
  BinChoice(const StorageRoom& room, const PostureGrid& grid, std::span<const BrickKind> sequence,
            const std::vector<Stack>& stacks)
      : grid_(grid), stacks_(stacks), bins_(binsOf(room)), stack_of_(sequence.size()) {
    serving_.resize(sequence.size());
    for (std::size_t s = 0; s < stacks.size(); ++s) {
      double height_m = 0.0;
      for (const std::size_t brick : stacks[s]) {
        stack_of_[brick] = s;
        for (const Bin& bin : bins_)
          serving_[brick].push_back(
              grid.serving({bin.compartment, bin.bin, height_m}, sequence[brick]));
        height_m += brickShape(sequence[brick]).length_m;
      }
    }
    for (const Stack& stack : stacks) {
      fits_.emplace_back();
      for (std::size_t b = 0; b < bins_.size(); ++b)
        fits_.back().push_back(std::none_of(stack.begin(), stack.end(), [&](std::size_t brick) {
          return isEmpty(serving_[brick][b]);
        }));
    }
  }

  /// @return the stack that finds no bin, if there is one.
  std::optional<std::size_t> choose() {
    stack_in_.assign(bins_.size(), kNoStack);
    bin_of_.assign(stacks_.size(), 0);
    for (std::size_t s = 0; s < stacks_.size(); ++s) {
      std::vector<bool> seen(bins_.size(), false);
      if (!match(s, seen)) return s;
    }
    improve();
    return std::nullopt;
  }
  [[nodiscard]] Bin binOf(std::size_t brick) const { return bins_[bin_of_[stack_of_[brick]]]; }
  [[nodiscard]] const PostureSet& serving(std::size_t brick) const {
    return serving_[brick][bin_of_[stack_of_[brick]]];
  }

 private:
  /// Kuhn's augmenting path.
  bool match(std::size_t stack, std::vector<bool>& seen) {
    for (std::size_t b = 0; b < bins_.size(); ++b) {
      if (seen[b] || !fits_[stack][b]) continue;
      seen[b] = true;
      if (stack_in_[b] != kNoStack && !match(stack_in_[b], seen)) continue;
      stack_in_[b] = stack;
      bin_of_[stack] = b;
      return true;
    }
    return false;
  }
  [[nodiscard]] int stops() const {
    int stops = 0;
    PostureSet here = grid_.all();
    for (std::size_t brick = 0; brick < stack_of_.size(); ++brick) {
      if (intersect(here, serving(brick))) continue;
      here = serving(brick);
      ++stops;
    }
    return stops;
  }
  bool exchange(std::size_t a, std::size_t b) {
    const std::size_t first = stack_in_[a], second = stack_in_[b];
    if (first == second) return false;  // both empty
    if ((first != kNoStack && !fits_[first][b]) || (second != kNoStack && !fits_[second][a]))
      return false;
    std::swap(stack_in_[a], stack_in_[b]);
    if (first != kNoStack) bin_of_[first] = b;
    if (second != kNoStack) bin_of_[second] = a;
    return true;
  }
  /// Exchanges of two bins as long as one saves a stop.
  int descend() {
    int least = stops();
    for (bool better = true; better;) {
      better = false;
      for (std::size_t a = 0; a < bins_.size(); ++a)
        for (std::size_t b = a + 1; b < bins_.size(); ++b) {
          if (!exchange(a, b)) continue;
          const int now = stops();
          if (now < least) {
            least = now;
            better = true;
          } else {
            exchange(a, b);
          }
        }
    }
    return least;
  }
  void improve() {
    std::mt19937_64 random(1);
    auto best_in = stack_in_;
    auto best_of = bin_of_;
    int least = descend();
    best_in = stack_in_;
    best_of = bin_of_;
    for (int restart = 0; restart < kRestarts && least > 0; ++restart) {
      for (std::size_t i = 0; i < 3 * bins_.size(); ++i)
        exchange(random() % bins_.size(), random() % bins_.size());
      const int now = descend();
      if (now >= least) continue;
      least = now;
      best_in = stack_in_;
      best_of = bin_of_;
    }
    stack_in_ = best_in;
    bin_of_ = best_of;
  }

  const PostureGrid& grid_;
  const std::vector<Stack>& stacks_;
  std::vector<Bin> bins_;
  std::vector<std::size_t> stack_of_;             ///< of each brick
  std::vector<std::vector<PostureSet>> serving_;  ///< of each brick, in each bin
  std::vector<std::vector<bool>> fits_;           ///< of each stack, in each bin
  std::vector<std::size_t> stack_in_, bin_of_;
};

/// Kinds drawn together, each stack from the floor up; of one kind first what can be set in without
/// a stop.
std::vector<std::size_t> loadOrder(const PostureGrid& grid, const BinChoice& choice,
                                   std::span<const BrickKind> sequence,
                                   const std::vector<Stack>& stacks) {
  std::vector<std::size_t> order, next(stacks.size(), 0);
  PostureSet here = grid.all();
  std::optional<BrickKind> kind;
  while (order.size() < sequence.size()) {
    std::size_t best = kNoStack;
    int best_rank = 0;
    for (std::size_t s = 0; s < stacks.size(); ++s) {
      if (next[s] == stacks[s].size()) continue;
      const std::size_t brick = stacks[s][next[s]];
      PostureSet both = here;
      const int rank = (kind && sequence[brick] == *kind ? 4 : 0) +
                       (intersect(both, choice.serving(brick)) ? 2 : 0) + (next[s] > 0 ? 1 : 0);
      if (best != kNoStack && rank <= best_rank) continue;
      best = s;
      best_rank = rank;
    }
    const std::size_t brick = stacks[best][next[best]++];
    if (!intersect(here, choice.serving(brick))) here = choice.serving(brick);
    kind = sequence[brick];
    order.push_back(brick);
  }
  return order;
}

/// Stands still as long as that serves, then goes to the nearest posture.
int addPostures(const PostureGrid& grid, const BinChoice& choice, StoragePosture at,
                std::vector<StorageStep>& steps) {
  int stops = 0;
  for (std::size_t from = 0; from < steps.size();) {
    PostureSet set = choice.serving(steps[from].brick);
    std::size_t to = from + 1;
    for (; to < steps.size(); ++to) {
      PostureSet both = set;
      if (!intersect(both, choice.serving(steps[to].brick))) break;
      set = std::move(both);
    }
    const StoragePosture next = grid.nearest(set, at);
    if (next != at) ++stops;
    at = next;
    for (; from < to; ++from) steps[from].posture = at;
  }
  return stops;
}

/// As long a beginning of the sequence as can be divided.
tl::unexpected<Error> tooMuch(std::span<const BrickKind> sequence, std::size_t bins,
                              const StackRule& rule) {
  std::size_t n = 1;
  while (n < sequence.size() && divideIntoStacks(sequence.first(n), bins, rule)) ++n;
  const BrickKind kind = sequence[n - 1];
  const auto before =
      std::count(sequence.begin(), sequence.begin() + static_cast<std::ptrdiff_t>(n), kind);
  return makeError(ErrorCode::InvalidInput,
                   "storage: brick {} of the build order, {} brick number {}, does not fit: no way "
                   "was found to stack the first {} in {} bins; make two loads of it",
                   n, brickShape(kind).name, before, n, bins);
}

}  // namespace

Result<StoragePlan> planStorage(const StorageRoom& room, const StorageConfig& config,
                                std::span<const BrickKind> sequence) {
  if (auto checked = checkRoom(room, config); !checked) return tl::make_unexpected(checked.error());
  if (auto fits = PostureGrid::fits(room, config); !fits) return tl::make_unexpected(fits.error());
  StoragePlan plan;
  plan.sequence.assign(sequence.begin(), sequence.end());
  if (sequence.empty()) return plan;
  const StackRule rule = [&](std::span<const BrickKind> stack) {
    for (std::size_t c = 0; c < room.rows.size(); ++c)
      if (std::string fault = stackFault(room, config, c, stack); !fault.empty()) return fault;
    return std::string();
  };
  const std::size_t bins = binsOf(room).size();
  const auto stacks = divideIntoStacks(sequence, bins, rule);
  if (!stacks) return tooMuch(sequence, bins, rule);
  const PostureGrid grid(room, config);
  BinChoice choice(room, grid, sequence, *stacks);
  if (const auto homeless = choice.choose()) {
    const std::size_t brick = (*stacks)[*homeless].back();
    return makeError(ErrorCode::InvalidInput,
                     "storage: brick {} of the build order ({}): no bin is left where the arm can "
                     "reach its seat and the way to it is free",
                     brick + 1, brickShape(sequence[brick]).name);
  }
  std::vector<double> height_m(sequence.size(), 0.0);
  for (const Stack& stack : *stacks)
    for (std::size_t i = 1; i < stack.size(); ++i)
      height_m[stack[i]] = height_m[stack[i - 1]] + brickShape(sequence[stack[i - 1]]).length_m;
  const auto step = [&](std::size_t brick) {
    const Bin bin = choice.binOf(brick);
    return StorageStep{brick, {bin.compartment, bin.bin, height_m[brick]}, {}};
  };
  for (const std::size_t brick : loadOrder(grid, choice, sequence, *stacks))
    plan.load.push_back(step(brick));
  for (std::size_t brick = 0; brick < sequence.size(); ++brick) plan.unload.push_back(step(brick));
  const StoragePosture rest(room.rows.size(), 0.0);
  plan.load_stops = addPostures(grid, choice, rest, plan.load);
  plan.unload_stops = addPostures(grid, choice, plan.load.back().posture, plan.unload);
  plan.mixed_bins = mixedStacks(sequence, *stacks);
  return plan;
}

}  // namespace kiln
