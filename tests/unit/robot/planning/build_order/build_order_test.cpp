#include "robot/planning/build_order/build_order.h"

#include <map>

#include <gmock/gmock.h>

#include "robot/planning/build_order/base_positions.h"
#include "robot/planning/build_order/prefix_states.h"
#include "tests/unit/robot/planning/build_order/exhaustive.h"
#include "tests/unit/robot/planning/build_order/walls.h"

namespace kiln {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using enum BrickKind;
using testing::problemOf;
using testing::smallWall;

BuildOrderConfig reach(double window_m) {
  BuildOrderConfig config;
  config.reach_window_m = window_m;
  return config;
}

TEST(OptimalOrder, IsAsCheapAsTheBestOfAllSequencesOnSmallWalls) {
  const std::vector<std::vector<BrickKind>> rows{
      {Red, Green, Red}, {Red, Green, Blue, Red}, {Green, Green, Red, Red}};
  for (unsigned seed = 0; seed < 120; ++seed) {
    const LegProblem problem = problemOf(smallWall(seed, 2 + seed % 2, rows[seed % 3]));
    const BuildOrderConfig config = reach(0.5 + 0.17 * (seed % 7));
    const auto order = planOptimalOrder(problem, config);
    ASSERT_TRUE(order.has_value()) << order.error();
    const BuildCost best = testing::ExhaustiveWall(problem, config).best(order->cost.positions);
    EXPECT_EQ(order->cost.positions, best.positions) << "seed " << seed;
    EXPECT_NEAR(order->cost.distance_m, best.distance_m, 1e-6) << "seed " << seed;
    EXPECT_TRUE(order->optimal_proven);
  }
}

/// Every state that can be reached, none left out: what the search's bound and dominance must not
/// change.
BuildCost leastOverAllStates(const LegProblem& problem, const BuildOrderConfig& config) {
  const PrefixStates states(problem, config);
  using Key = std::pair<Prefix, std::size_t>;
  std::map<Key, double> level;
  for (std::size_t p = 0; p < states.positions().size(); ++p)
    level[{states.buildFrom(p, {}), p}] = 0.0;
  for (int used = 1; used < 40; ++used) {
    double best_m = -1.0;
    for (const auto& [key, way_m] : level)
      if (key.first == states.goal() && (best_m < 0.0 || way_m < best_m)) best_m = way_m;
    if (best_m >= 0.0) return {used, best_m};
    std::map<Key, double> next;
    for (const auto& [key, way_m] : level)
      for (std::size_t p = 0; p < states.positions().size(); ++p) {
        const Prefix after = states.buildFrom(p, key.first);
        if (after == key.first) continue;
        const double further =
            way_m + std::abs(states.positions()[p] - states.positions()[key.second]);
        const auto [known, fresh] = next.try_emplace({after, p}, further);
        if (!fresh) known->second = std::min(known->second, further);
      }
    level = std::move(next);
  }
  return {};
}

TEST(OptimalOrder, IsTheLeastOverAllStatesOnOfficialWalls) {
  for (std::uint64_t seed = 1; seed <= 140; ++seed) {
    const LegProblem problem = problemOf(randomBlueprint(seed));
    const BuildOrderConfig config = reach(0.9 + 0.1 * static_cast<double>(seed % 7));
    const auto order = planOptimalOrder(problem, config);
    ASSERT_TRUE(order.has_value()) << order.error();
    const BuildCost least = leastOverAllStates(problem, config);
    EXPECT_EQ(order->cost.positions, least.positions) << "seed " << seed;
    EXPECT_NEAR(order->cost.distance_m, least.distance_m, 1e-6) << "seed " << seed;
  }
}

TEST(OptimalOrder, IsProvenByItsOwnBoundOnAThousandWalls) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const LegProblem problem = problemOf(randomBlueprint(seed));
    const BuildOrderConfig config = reach(0.9 + 0.1 * static_cast<double>(seed % 7));
    const auto order = planOptimalOrder(problem, config), greedy = planGreedyOrder(problem, config);
    ASSERT_TRUE(order.has_value() && greedy.has_value());
    ASSERT_TRUE(order->optimal_proven) << "seed " << seed;
    ASSERT_EQ(order->lower_bound.positions, order->cost.positions);
    ASSERT_NEAR(order->lower_bound.distance_m, order->cost.distance_m, 1e-6);
    ASSERT_FALSE(cheaper(greedy->cost, order->cost));
    for (const auto& plan : {order, greedy}) {
      const auto checked = checkBuildOrder(problem, config, *plan, LayerRule::LeftToRight);
      ASSERT_TRUE(checked.has_value()) << "seed " << seed << ": " << checked.error();
    }
  }
}

TEST(OptimalOrder, BoundNeverExceedsWhatIsLeft) {
  // Along an optimal order: from each state the rest of that very order is a way that exists.
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const LegProblem problem = problemOf(randomBlueprint(seed));
    const BuildOrderConfig config = reach(1.0);
    const auto order = planOptimalOrder(problem, config);
    ASSERT_TRUE(order.has_value()) << order.error();
    const PrefixStates states(problem, config);
    BuildCost left = order->cost;
    Prefix built{};
    for (std::size_t i = 0; i + 1 < order->positions.size(); ++i) {
      const auto& all = states.positions();
      const auto here = static_cast<std::size_t>(
          std::lower_bound(all.begin(), all.end(), order->positions[i].base_m - 1e-9) -
          all.begin());
      built = states.buildFrom(here, built);
      --left.positions;
      if (i > 0)
        left.distance_m -= std::abs(order->positions[i].base_m - order->positions[i - 1].base_m);
      const BuildCost bound = states.remainingAtLeast(here, built);
      ASSERT_LE(bound.positions, left.positions);
      ASSERT_LE(bound.distance_m, left.distance_m + 1e-6);
    }
  }
}

TEST(OptimalOrder, SaysSoWhenItsSearchWasCutShort) {
  BuildOrderConfig config = reach(0.9);
  config.most_states = 3;
  const LegProblem problem = problemOf(randomBlueprint(1));
  const auto cut = planOptimalOrder(problem, config), full = planOptimalOrder(problem, reach(0.9));
  ASSERT_TRUE(cut.has_value() && full.has_value());
  EXPECT_FALSE(cut->optimal_proven);
  EXPECT_FALSE(cheaper(cut->cost, full->cost));
  EXPECT_FALSE(cheaper(full->cost, cut->lower_bound));
  EXPECT_TRUE(checkBuildOrder(problem, config, *cut, LayerRule::LeftToRight).has_value());
}

TEST(OptimalOrder, BuildsTheOrangeLegFromTwoPositionsAsThePaperDoes) {
  const LegProblem problem = problemOf(randomBlueprint(1), WallLeg::Orange);
  const auto order = planOptimalOrder(problem, reach(1.1));
  ASSERT_TRUE(order.has_value()) << order.error();
  ASSERT_EQ(order->positions.size(), 2U);
  EXPECT_EQ(order->positions[0].slots.size(), 5U);  // one stack, then the other
  EXPECT_NEAR(order->cost.distance_m, 1.8 + kPlannedJoint_m, 1e-9);
}

TEST(OptimalOrder, ReachesEveryBrickWithAnyWindow) {
  // With no window at all each centre has its position: 7 to 35 of them (paper).
  const LegProblem problem = problemOf(smallWall(1, 2, {Red, Green}));
  const auto order = planOptimalOrder(problem, reach(0.0));
  ASSERT_TRUE(order.has_value()) << order.error();
  EXPECT_GE(order->cost.positions, 2);
  EXPECT_LE(order->cost.positions, 4);
}

TEST(OptimalOrder, NamesTheBrickThatNoPositionReaches) {
  BuildOrderConfig config = reach(0.9);
  config.base_max_m = 2.5;  // something stands further right
  const auto order = planOptimalOrder(problemOf(randomBlueprint(1)), config);
  ASSERT_FALSE(order.has_value());
  EXPECT_THAT(order.error().message,
              AllOf(HasSubstr("layer 1"), HasSubstr("line 5, column"), HasSubstr("out of reach")));
  config.base_min_m = 3.0;
  EXPECT_FALSE(planOptimalOrder(problemOf(randomBlueprint(1)), config).has_value());
  EXPECT_FALSE(planGreedyOrder(problemOf(randomBlueprint(1)), reach(-1.0)).has_value());
  EXPECT_FALSE(planGreedyOrder(problemOf(randomBlueprint(1)), reach(std::nan(""))).has_value());
}

TEST(LegProblem, RefusesWhatLiesOnNothing) {
  Blueprint wall;
  wall.orange_leg = false;
  wall.layers = {{Red, Red}, {Red, Blue}};  // 0.6 m, then 1.5 m
  const auto problem = makeLegProblem(wallSlots(wall), WallLeg::Mixed);
  ASSERT_FALSE(problem.has_value());
  EXPECT_THAT(problem.error().message,
              AllOf(HasSubstr("blue, layer 2, 2nd"), HasSubstr("line 1, column 3")));
  wall.layers = {std::vector<BrickKind>(kMostLayerBricks + 1, Red)};
  EXPECT_FALSE(makeLegProblem(wallSlots(wall), WallLeg::Mixed).has_value());
  wall.layers = {{Red}, {}, {Red}};
  EXPECT_FALSE(makeLegProblem(wallSlots(wall), WallLeg::Mixed).has_value());
}

TEST(BuildOrderCheck, FindsWhatIsWrongWithAnOrder) {
  const LegProblem problem = problemOf(randomBlueprint(3));
  const BuildOrderConfig config = reach(1.1);
  const auto good = planOptimalOrder(problem, config);
  ASSERT_TRUE(good.has_value()) << good.error();
  const auto faultOf = [&](const BuildOrder& order) {
    const auto checked = checkBuildOrder(problem, config, order, LayerRule::LeftToRight);
    return checked ? std::string("nothing") : checked.error().message;
  };
  EXPECT_EQ(faultOf(*good), "nothing");
  BuildOrder bad = *good;
  bad.positions.back().slots.pop_back();
  EXPECT_THAT(faultOf(bad), HasSubstr("never built"));
  bad = *good;
  bad.positions[0].slots.push_back(bad.positions[0].slots[0]);
  EXPECT_THAT(faultOf(bad), HasSubstr("built twice"));
  bad = *good;
  std::reverse(bad.positions[0].slots.begin(), bad.positions[0].slots.end());
  EXPECT_THAT(faultOf(bad), AllOf(HasSubstr("layer"), HasSubstr("not built yet")));
  bad = *good;
  bad.positions[0].base_m += 1.5;
  EXPECT_THAT(faultOf(bad), HasSubstr("out of reach"));
  bad = *good;
  bad.cost.distance_m += 0.1;
  EXPECT_THAT(faultOf(bad), HasSubstr("is said to need"));
  bad = *good;
  bad.positions[0].slots[0] = 9999;
  EXPECT_THAT(faultOf(bad), HasSubstr("none of this leg"));
}

}  // namespace
}  // namespace kiln
