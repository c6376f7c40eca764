// Whole missions: kiln-sim and kiln-robotd as processes of their own, in lockstep.
#include <csignal>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "robot/evaluation/child_process.h"
#include "robot/evaluation/mission_run.h"
#include "robot/evaluation/truth.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using nlohmann::json;
using std::chrono::seconds;

std::string program(const std::string& name) { return kiln::binaryDir() + "/bin/" + name; }

TEST(FireMission, PutsTheFireOutAndReportsTheSameBytesTwice) {
  MissionRunOptions options;
  options.programs = kiln::binaryDir() + "/bin";
  const auto first = runMission(options);
  ASSERT_TRUE(first.has_value()) << first.error();
  EXPECT_TRUE(first->success) << first->report_json;
  const json report = json::parse(first->report_json);
  for (const char* key :
       {"outcome", "simulated_s", "litres_delivered", "collisions", "states", "resets", "score"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["score"], 6.0);
  EXPECT_EQ(report["litres_delivered"].size(), 2U) << "one figure a fire place";
  const auto second = runMission(options);
  ASSERT_TRUE(second.has_value()) << second.error();
  EXPECT_EQ(first->report_json, second->report_json);
}

/// A mission whose daemon is killed without warning while it is in `state`.
class KilledMission : public testing::TestWithParam<const char*> {
 protected:
  std::vector<std::string> robotCommand(bool resume) const {
    std::vector<std::string> argv{program("kiln-robotd"),
                                  "--sim",
                                  "ipc://" + scratch_.file("world"),
                                  "--lockstep",
                                  "--start",
                                  "--exit-when-done",
                                  "--report",
                                  scratch_.file("robot.json"),
                                  "--state-dir",
                                  scratch_.file("state"),
                                  "--listen",
                                  "ipc://" + scratch_.file("link")};
    if (resume) argv.emplace_back("--resume");
    return argv;
  }
  /// The state that the checkpoint file names, or empty.
  std::string checkpointedState() const {
    std::ifstream in(scratch_.file("state") + "/fire.checkpoint");
    const json checkpoint = json::parse(in, nullptr, false);
    if (checkpoint.is_discarded()) return {};
    return checkpoint.at("body").at("fsm").at("state").get<std::string>();
  }
  ScratchFolder scratch_{"resume"};
};

TEST_P(KilledMission, GoesOnWhereItStood) {
  auto world = ChildProcess::start(
      {program("kiln-sim"), "--lockstep", "--seed", "1", "--listen",
       "ipc://" + scratch_.file("world"), "--truth", scratch_.file("truth.json")},
      scratch_.file("sim.log"));
  ASSERT_TRUE(world.has_value()) << world.error();
  {
    auto robot = ChildProcess::start(robotCommand(false), scratch_.file("first.log"));
    ASSERT_TRUE(robot.has_value()) << robot.error();
    while (checkpointedState() != GetParam()) {
      ASSERT_FALSE(robot->wait(std::chrono::milliseconds(5)).has_value())
          << "ended before " << GetParam() << "\n"
          << tailOf(scratch_.file("first.log"), 8);
    }
    robot->signal(SIGKILL);
    ASSERT_EQ(robot->wait(seconds(5)), 128 + SIGKILL);
  }
  ASSERT_TRUE(world->running()) << "the world outlives the daemon";
  auto robot = ChildProcess::start(robotCommand(true), scratch_.file("second.log"));
  ASSERT_TRUE(robot.has_value()) << robot.error();
  EXPECT_EQ(robot->wait(seconds(150)), 0) << tailOf(scratch_.file("second.log"), 8);
  world->signal(SIGTERM);
  ASSERT_TRUE(world->wait(seconds(10)).has_value());
  std::ifstream in(scratch_.file("truth.json"));
  const json truth = json::parse(in, nullptr, false);
  ASSERT_FALSE(truth.is_discarded());
  EXPECT_GE(burningLitres(truth), 1.0) << truth.dump();
  EXPECT_TRUE(truth["collisions"].empty()) << truth["collisions"].dump();
}

INSTANTIATE_TEST_SUITE_P(States, KilledMission,
                         testing::Values("DriveToLocation", "ArmSearch", "SpraySteady"));

}  // namespace
}  // namespace kiln
