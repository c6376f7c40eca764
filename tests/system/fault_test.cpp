// What goes wrong with a device must end in a defined way: the mission goes on, or ends in the
// state that is made for it, with the words for it; never in a hang, a crash or water that runs on.
// Lockstep.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "robot/evaluation/mission_run.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using nlohmann::json;
using ::testing::Contains;

struct FaultyRun {
  MissionRun run;
  json report;
  std::vector<std::string> states;
};

FaultyRun runWith(const std::string& fault, const std::string& may_touch = "") {
  MissionRunOptions options;
  options.programs = kiln::binaryDir() + "/bin";
  options.world_args = {"--fault", fault};
  auto run = runMission(options);
  if (!run) {
    ADD_FAILURE() << run.error().message;
    return {};
  }
  FaultyRun out{*run, json::parse(run->report_json), {}};
  for (const json& state : out.report["states"]) out.states.push_back(state["name"]);
  for (const json& collision : out.report["collisions"])
    EXPECT_EQ(collision["other"], may_touch) << out.report["collisions"].dump();
  return out;
}

int visits(const FaultyRun& run, const std::string& state) {
  return static_cast<int>(std::count(run.states.begin(), run.states.end(), state));
}

// Through the first sweep and into the second: the picture does not change, so it is refused, and
// what was not seen is searched again.
TEST(Faults, AThermalCameraThatFreezesForAWhileDelaysTheMissionOnly) {
  const FaultyRun run = runWith("thermal_freeze@40:20");
  ASSERT_FALSE(run.states.empty());
  EXPECT_TRUE(run.run.success) << run.run.report_json;
}

TEST(Faults, BlockedPumpsAreTriedOnceMoreThenThePlaceIsLeft) {
  const FaultyRun run = runWith("pump_blocked@35:2000");
  ASSERT_FALSE(run.states.empty());
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_GE(visits(run, "PumpFault"), 2);
  EXPECT_EQ(visits(run, "SpraySteady"), 0) << "nothing is sprayed without current";
  EXPECT_THAT(run.states, Contains("NextLocation"));
  EXPECT_THAT(run.states.back(), testing::AnyOf("NothingFound", "SafeStop"));
  EXPECT_NE(run.report["reason"].get<std::string>().find("the pumps do not run"), std::string::npos)
      << run.report["reason"];
}

// The arm, 6.6 s after it began to unfold, meets the box, withdraws from it, waits and tries again
// when it has gone.
TEST(Faults, AnArmThatMeetsSomethingWithdrawsAndTriesAgain) {
  const FaultyRun run = runWith("arm_obstacle@31.2:5", "obstacle");
  ASSERT_FALSE(run.states.empty());
  EXPECT_FALSE(run.report["collisions"].empty()) << "the arm never met it";
  EXPECT_GE(visits(run, "ArmBlocked"), 1);
  EXPECT_EQ(visits(run, "ProtectiveStop"), 0);
  EXPECT_EQ(run.report["mission_outcome"], "success") << run.run.report_json;
}

TEST(Faults, AProtectiveStopThatNobodyReleasesEndsWithTheClockAndTheReason) {
  const FaultyRun run = runWith("protective_stop@30:0.1");
  ASSERT_GE(run.states.size(), 2U);
  EXPECT_EQ(run.states.back(), "SafeStop");
  EXPECT_EQ(run.states[run.states.size() - 2], "ProtectiveStop");
  EXPECT_EQ(visits(run, "StartPump"), 0);
  EXPECT_NE(run.report["reason"].get<std::string>().find("before the arm was released"),
            std::string::npos)
      << run.report["reason"];
}

}  // namespace
}  // namespace kiln
