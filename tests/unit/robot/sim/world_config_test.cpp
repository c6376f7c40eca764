#include "robot/sim/world_config.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "robot/sim/world.h"

namespace kiln::sim {
namespace {

using ::testing::HasSubstr;

TEST(WorldConfig, ShippedFireWorldLoads) {
  const auto config = WorldConfig::load(*resourcePath("worlds/fire.yaml"));
  ASSERT_TRUE(config.has_value()) << config.error();
  EXPECT_EQ(config->name, "fire");
  EXPECT_EQ(config->distractors.size(), 3u);
}

TEST(WorldConfig, MissingFileIsOneSentenceWithThePath) {
  const auto config = WorldConfig::load("no/such/world.yaml");
  ASSERT_FALSE(config.has_value());
  EXPECT_THAT(config.error().message, HasSubstr("no/such/world.yaml"));
}

TEST(WorldConfig, UnknownKeyNamesFileLineAndNeighbour) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "kiln_bad_world.yaml";
  std::ofstream(path) << "name: x\nwater:\n  flow_lpmm: 2\n";
  const auto config = WorldConfig::load(path.string());
  std::filesystem::remove(path);
  ASSERT_FALSE(config.has_value());
  EXPECT_THAT(config.error().message, HasSubstr(":3:"));
  EXPECT_THAT(config.error().message, HasSubstr("flow_lpm"));
}

TEST(WorldConfig, ArenaThatIsNotThereIsNamed) {
  WorldConfig config;
  config.arena = "config/atlantis.yaml";
  const auto world = World::create(config, 1);
  ASSERT_FALSE(world.has_value());
  EXPECT_THAT(world.error().message, HasSubstr("atlantis"));
}

TEST(FaultConfig, ReadsNameTimeAndDuration) {
  const auto fault = FaultConfig::parse("pump_blocked@12.5:3");
  ASSERT_TRUE(fault.has_value()) << fault.error();
  EXPECT_EQ(fault->name, "pump_blocked");
  EXPECT_DOUBLE_EQ(fault->at_s, 12.5);
  EXPECT_DOUBLE_EQ(fault->duration_s, 3.0);
}

TEST(FaultConfig, RefusesWhatItCannotDo) {
  for (const char* bad : {"pump_blocked", "meteor@3", "pump_blocked@", "pump_blocked@x",
                          "pump_blocked@3:", "pump_blocked@3:-1", "pump_blocked@nan", "", "@"}) {
    EXPECT_FALSE(FaultConfig::parse(bad).has_value()) << bad;
  }
}

}  // namespace
}  // namespace kiln::sim
