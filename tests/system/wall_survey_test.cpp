// The wall mission as far as it goes by itself, in the lab's world: kiln-sim and kiln-robotd as processes of
// their own, in lockstep.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "robot/evaluation/child_process.h"
#include "robot/evaluation/mission_run.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using nlohmann::json;

MissionRunOptions survey(int seed) {
  MissionRunOptions options;
  options.programs = kiln::binaryDir() + "/bin";
  options.mission = "wall";
  options.seed = seed;
  options.robot_args = {"--set", "wall.loading.bricks=0"};
  return options;
}

TEST(WallSurvey, FindsPileAndMarkerWhereTheyAreAndTouchesNothing) {
  for (const int seed : {1, 2}) {
    const auto run = runMission(survey(seed));
    ASSERT_TRUE(run.has_value()) << run.error();
    EXPECT_TRUE(run->success) << run->report_json;
    const json report = json::parse(run->report_json);
    ASSERT_TRUE(report.contains("pile_off")) << run->report_json;
    EXPECT_LT(report["pile_off"]["position_m"], 0.15) << seed;
    EXPECT_LT(report["pile_off"]["yaw_deg"], 5.0) << seed;
    EXPECT_LT(report["marker_off"]["position_m"], 0.2) << seed;
    EXPECT_LT(report["marker_off"]["yaw_deg"], 3.0) << seed;
    EXPECT_EQ(report["bricks_off_m"].size(), 11u) << seed;  // trusted
    for (const json& off_m : report["bricks_off_m"]) EXPECT_LT(off_m, 0.15) << seed;
    EXPECT_EQ(report["collisions"].size(), 0u) << seed;
    EXPECT_EQ(report["falls"], 0) << seed;
  }
}

TEST(WallSurvey, KilledBetweenPileAndMarkerItGoesOnAndKnowsThePile) {
  MissionRunOptions options = survey(3);
  options.trace = true;
  options.kill = Kill{};
  options.kill->at_s = 12.0;
  const auto run = runMission(options);
  ASSERT_TRUE(run.has_value()) << run.error();
  ASSERT_TRUE(run->killed.has_value());
  EXPECT_TRUE(run->success) << run->report_json;
}

/// The truth says that it stands in the storage, and the robot knows it.
TEST(WallSurvey, TakesABrickIntoItsStorageWhenToldTo) {
  MissionRunOptions options = survey(1);
  options.trace = true;
  options.robot_args = {"--set", "wall.loading.bricks=1"};
  const auto run = runMission(options);
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_TRUE(run->success) << run->report_json;
  const json report = json::parse(run->report_json);
  EXPECT_EQ(report["stored"], 1);
  EXPECT_EQ(report["stored_truly"], 1);
  EXPECT_EQ(report["falls"], 0);
}

TEST(WallSurvey, ABlueprintThatCannotBeReadIsRefusedBeforeAnythingMoves) {
  MissionRunOptions options = survey(1);
  ScratchFolder folder("blueprint");
  options.robot_args = {"--set", "wall.blueprint=" + folder.file("none.txt")};
  options.wall_limit_s = 20.0;
  const auto run = runMission(options);
  ASSERT_FALSE(run.has_value());
  EXPECT_NE(run.error().message.find("none.txt"), std::string::npos) << run.error();
}

}  // namespace
}  // namespace kiln
