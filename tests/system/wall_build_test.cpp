// The wall mission from end to end in the lab's world: kiln-sim and kiln-robotd as processes of their own, in
// lockstep.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "robot/evaluation/child_process.h"
#include "robot/evaluation/mission_run.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using nlohmann::json;

/// The lab's run from end to end: by the simulator's referee every brick stands in its slot.
TEST(WallBuild, BuildsTheWallOfTheBlueprint) {
  MissionRunOptions options;
  options.programs = kiln::binaryDir() + "/bin";
  options.mission = "wall";
  options.seed = 2;
  ScratchFolder folder("calibration");
  const std::string file = folder.file("mario.yaml");
  auto calibrated = ChildProcess::start({kiln::binaryDir() + "/bin/kiln-eval", "calibrate",
                                         "--world", "wall_lab", "--seeds", "2-2", "--out", file},
                                        folder.file("log"));
  ASSERT_TRUE(calibrated.has_value()) << calibrated.error();
  ASSERT_EQ(calibrated->wait(std::chrono::seconds(120)), 0);
  options.robot_args = {"--calibration", file};
  const auto run = runMission(options);
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_TRUE(run->success) << run->report_json;
  const json report = json::parse(run->report_json);
  EXPECT_EQ(report["built"], 11);
  EXPECT_EQ(report["placed"], 11);
  EXPECT_EQ(report["points"], 21);
  EXPECT_EQ(report["falls"], 0);
  EXPECT_EQ(report["collisions"].size(), 0u);
}

}  // namespace
}  // namespace kiln
