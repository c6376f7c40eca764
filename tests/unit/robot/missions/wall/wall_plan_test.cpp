#include "robot/missions/wall/wall_plan.h"

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/missions/wall/wall_config.h"
#include "robot/scene/blueprint.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;

RobotGeometry robot(const std::string& file) {
  const auto loaded = loadResource<RobotGeometry>("robot_model/" + file);
  EXPECT_TRUE(loaded) << loaded.error();
  return *loaded;
}

TEST(WallPlan, TheLabsWallIsOneLoadAndEachSlotIsFilledOnce) {
  const auto plan = planWall({}, robot("mario.yaml"));
  ASSERT_TRUE(plan.has_value()) << plan.error();
  ASSERT_EQ(plan->loads.size(), 1u);
  const WallLoad& load = plan->loads.front();
  std::vector<std::size_t> slots = load.slots;
  std::sort(slots.begin(), slots.end());
  ASSERT_EQ(slots.size(), 11u);
  for (std::size_t i = 0; i < slots.size(); ++i) EXPECT_EQ(slots[i], i);
  ASSERT_EQ(load.storage.sequence.size(), 11u);
  for (std::size_t i = 0; i < load.slots.size(); ++i)
    EXPECT_EQ(load.storage.sequence[i], plan->slots[load.slots[i]].kind);
  EXPECT_GT(load.expected_s, 11 * 17.0);
}

TEST(WallPlan, TheOfficialWallIsTheOrangeLegAndThenTheRest) {
  WallConfig config;
  config.blueprint = ::testing::TempDir() + "/planned_wall.txt";
  ASSERT_TRUE(saveBlueprint(randomBlueprint(4), config.blueprint).has_value());
  const auto plan = planWall(config, robot("bob_wall.yaml"));
  ASSERT_TRUE(plan.has_value()) << plan.error();
  ASSERT_EQ(plan->loads.size(), 2u);
  EXPECT_EQ(plan->loads[0].leg, WallLeg::Orange);
  EXPECT_EQ(plan->loads[0].slots.size(), 10u);
  EXPECT_EQ(plan->loads[1].slots.size(), 35u);
}

TEST(WallPlan, WhatCannotBeReadOrCarriedIsRefusedWithTheReason) {
  WallConfig config;
  config.blueprint = ::testing::TempDir() + "/no/wall.txt";
  const auto none = planWall(config, robot("mario.yaml"));
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error().message, HasSubstr("wall.txt"));
  config.blueprint = ::testing::TempDir() + "/wall.txt";
  std::ofstream(config.blueprint) << "R R G X\n";
  const auto wrong = planWall(config, robot("mario.yaml"));
  ASSERT_FALSE(wrong.has_value());
  EXPECT_THAT(wrong.error().message, HasSubstr("wall.txt:1:7"));
  // 45 bricks do not go into one compartment.
  ASSERT_TRUE(saveBlueprint(randomBlueprint(4), config.blueprint).has_value());
  const auto small = planWall(config, robot("mario.yaml"));
  ASSERT_FALSE(small.has_value());
  EXPECT_THAT(small.error().message, HasSubstr("cannot be built as configured"));
}

}  // namespace
}  // namespace kiln
