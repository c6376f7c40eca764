#include "robot/planning/build_order/build_time.h"

#include <map>
#include <tuple>

#include <gmock/gmock.h>

#include "tests/unit/robot/planning/build_order/walls.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;
using enum BrickKind;
using testing::problemOf;
using testing::smallWall;

double movingTime(const BuildOrder& order, const BuildTimeConfig& time) {
  return order.cost.positions * (time.look_s + time.base_move_s) +
         order.cost.distance_m / time.base_speed_mps;
}

/// Least moving time over all sequences of positions, all places where layers begin and all bricks
/// that may wait, without bounds or dominance. Bricks are laid one by one; only the very same wall
/// from the very same position is not looked at twice.
class EveryWay {
 public:
  EveryWay(const LegProblem& problem, const BuildOrderConfig& config, const BuildTimeConfig& time)
      : problem_(problem), config_(config), time_(time) {
    for (const auto& layer : problem.layers) {
      stands_.emplace_back(layer.size(), false);
      for (const LegBrick& brick : layer)
        for (const double window : {0.0, config.reach_window_m})
          positions_.push_back(brick.center_m + config.reach_shift_m - window);
    }
  }
  double least(double limit_s) {
    best_s_ = limit_s;
    for (const double base : positions_) lay(base, time_.look_s + time_.base_move_s, false);
    return best_s_;
  }

 private:
  [[nodiscard]] bool fits(std::size_t layer, std::size_t i, double base_m) const {
    const LegBrick& brick = problem_.layers[layer][i];
    const double from = base_m - config_.reach_shift_m;
    if (stands_[layer][i] || brick.center_m < from - 1e-6 ||
        brick.center_m > from + config_.reach_window_m + 1e-6)
      return false;
    for (std::size_t k = brick.first_below; k < brick.end_below; ++k)
      if (!stands_[layer - 1][k]) return false;
    const auto& row = stands_[layer];
    const bool left = i > 0 && row[i - 1], right = i + 1 < row.size() && row[i + 1];
    const bool first = std::find(row.begin(), row.end(), true) == row.end();
    return left != right || first;
  }
  void lay(double base_m, double spent_s, bool laid) {
    if (spent_s >= best_s_ - 1e-9) return;
    const auto [known, fresh] = seen_.try_emplace({stands_, base_m, laid}, spent_s);
    if (!fresh && known->second <= spent_s) return;
    known->second = spent_s;
    bool complete = true;
    for (std::size_t layer = 0; layer < stands_.size(); ++layer)
      for (std::size_t i = 0; i < stands_[layer].size(); ++i) {
        complete = complete && stands_[layer][i];
        if (!fits(layer, i, base_m)) continue;
        stands_[layer][i] = true;
        lay(base_m, spent_s, true);
        stands_[layer][i] = false;
      }
    if (complete) best_s_ = spent_s;
    if (complete || !laid) return;
    for (const double next : positions_)
      if (next != base_m)
        lay(next,
            spent_s + time_.look_s + time_.base_move_s +
                std::abs(next - base_m) / time_.base_speed_mps,
            false);
  }

  const LegProblem& problem_;
  const BuildOrderConfig& config_;
  const BuildTimeConfig& time_;
  std::vector<std::vector<bool>> stands_;
  std::vector<double> positions_;
  std::map<std::tuple<std::vector<std::vector<bool>>, double, bool>, double> seen_;
  double best_s_ = 0.0;
};

TEST(FastestOrder, IsTheLeastOfEveryWayOnSmallWalls) {
  const std::vector<std::vector<BrickKind>> rows{{Red, Green, Red}, {Green, Red}, {Red, Blue, Red}};
  for (unsigned seed = 0; seed < 60; ++seed) {
    const LegProblem problem = problemOf(smallWall(seed, 2, rows[seed % 3]));
    BuildOrderConfig config;
    config.reach_window_m = 0.4 + 0.15 * (seed % 4);
    BuildTimeConfig time;
    time.base_speed_mps = seed % 2 == 0 ? 0.3 : 0.02;  // the way weighs little, or much
    const auto order = planFastestOrder(problem, config, time);
    ASSERT_TRUE(order.has_value()) << order.error();
    EXPECT_TRUE(order->optimal_proven);
    const double found_s = movingTime(*order, time);
    EXPECT_NEAR(EveryWay(problem, config, time).least(found_s + 1e-6), found_s, 2e-6)
        << "seed " << seed;
  }
}

TEST(FastestOrder, TakesNoLongerThanTheOthersAndKeepsTheRule) {
  const BuildTimeConfig time;
  double saved_s = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const LegProblem problem = problemOf(randomBlueprint(seed));
    const BuildOrderConfig config;
    const auto fastest = planFastestOrder(problem, config, time);
    const auto optimal = planOptimalOrder(problem, config);
    ASSERT_TRUE(fastest.has_value() && optimal.has_value());
    const auto checked = checkBuildOrder(problem, config, *fastest, LayerRule::OneRun);
    ASSERT_TRUE(checked.has_value()) << "seed " << seed << ": " << checked.error();
    EXPECT_TRUE(fastest->optimal_proven);
    const double gain_s =
        expectedTime(problem, *optimal, time) - expectedTime(problem, *fastest, time);
    EXPECT_GE(gain_s, -1e-6) << "seed " << seed;
    saved_s += gain_s;
  }
  EXPECT_GT(saved_s / 40.0, 3.0);
}

TEST(BuildTime, AddsUpWhatTheOrderTakes) {
  const LegProblem problem = problemOf(smallWall(1, 1, {Red, Green, Blue}));
  BuildOrder order;
  order.positions = {{1.0, {0, 1}}, {1.6, {2}}};
  BuildTimeConfig time;
  time.red_s = 10;
  time.green_s = 20;
  time.blue_s = 40;
  time.look_s = 3;
  time.base_move_s = 2;
  time.base_speed_mps = 0.3;
  time.kind_change_s = 7;
  // 70 of the arm, two looks, one move of 0.6 m, two changes of kind
  EXPECT_NEAR(expectedTime(problem, order, time), 70 + 6 + 2 + 2 + 14, 1e-9);
}

TEST(BuildTime, RefusesCostsThatMeanNothing) {
  const LegProblem problem = problemOf(smallWall(1, 1, {Red}));
  BuildTimeConfig time;
  time.base_speed_mps = 0.0;
  EXPECT_FALSE(planFastestOrder(problem, {}, time).has_value());
  time = {};
  time.look_s = std::nan("");
  EXPECT_FALSE(planFastestOrder(problem, {}, time).has_value());
  time = {};
  time.red_s = -1.0;
  EXPECT_FALSE(planFastestOrder(problem, {}, time).has_value());
}

TEST(GroupKinds, ChangesNoPositionAndNoRule) {
  int before = 0, after = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const LegProblem problem = problemOf(randomBlueprint(seed));
    const auto order = planOptimalOrder(problem, {});
    ASSERT_TRUE(order.has_value()) << order.error();
    const BuildOrder grouped = groupKinds(problem, *order, LayerRule::LeftToRight);
    const auto checked = checkBuildOrder(problem, {}, grouped, LayerRule::LeftToRight);
    ASSERT_TRUE(checked.has_value()) << checked.error();
    before += kindChanges(problem, *order);
    after += kindChanges(problem, grouped);
    EXPECT_LE(kindChanges(problem, grouped), kindChanges(problem, *order));
  }
  EXPECT_LT(after, before);
}

TEST(OneRun, ForbidsWhatGoesBetweenTwoBuiltOnes) {
  const LegProblem problem = problemOf(smallWall(1, 1, {Red, Red, Red}));
  BuildOrderConfig config;
  BuildOrder order;
  order.cost = {1, 0.0};
  const auto faultOf = [&](std::vector<std::size_t> slots) {
    order.positions = {{1.1, std::move(slots)}};
    const auto checked = checkBuildOrder(problem, config, order, LayerRule::OneRun);
    return checked ? std::string("nothing") : checked.error().message;
  };
  EXPECT_EQ(faultOf({2, 1, 0}), "nothing");
  EXPECT_EQ(faultOf({1, 0, 2}), "nothing");
  EXPECT_THAT(faultOf({0, 2, 1}), HasSubstr("second run"));
}

}  // namespace
}  // namespace kiln
