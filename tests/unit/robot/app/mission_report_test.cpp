#include "robot/app/mission_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace kiln {
namespace {

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

FsmStatus statusWith(std::vector<FsmHistoryEntry> history) {
  FsmStatus status;
  status.history = std::move(history);
  return status;
}

TEST(MissionReport, CollectsEveryStateThoughTheHistoryIsBounded) {
  MissionReport report("fire", at(10));
  report.observe(statusWith({{1, "Start", at(10), {}, TransitionCause::Start, ""}}));
  report.observe(statusWith({{1, "Start", at(10), at(12), TransitionCause::Start, ""},
                             {2, "Enter", at(12), {}, TransitionCause::Normal, ""}}));
  // The history has forgotten the first state by now.
  report.observe(statusWith({{2, "Enter", at(12), at(15.5), TransitionCause::Normal, ""},
                             {3, "Finished", at(15.5), {}, TransitionCause::Operator, "by Ann"}}));
  const auto json = nlohmann::json::parse(report.toJson(at(16)));
  ASSERT_EQ(json["states"].size(), 3U);
  EXPECT_EQ(json["states"][0]["leave"], 2.0);
  EXPECT_EQ(json["states"][1]["name"], "Enter");
  EXPECT_EQ(json["states"][1]["leave"], 5.5);
  EXPECT_EQ(json["states"][2]["leave"], 6.0) << "the current state lasts until now";
  EXPECT_EQ(json["states"][2]["cause"], "operator");
}

TEST(MissionReport, SaysHowTheMissionEnded) {
  FsmStatus status;
  MissionReport report("fire", at(0));
  EXPECT_EQ(nlohmann::json::parse(report.toJson(at(1)))["outcome"], "unfinished");
  status.terminal = true;
  report.observe(status);
  EXPECT_EQ(nlohmann::json::parse(report.toJson(at(1)))["outcome"], "failed");
  status.success = true;
  report.observe(status);
  EXPECT_EQ(nlohmann::json::parse(report.toJson(at(1)))["outcome"], "success");
}

TEST(MissionReport, KeepsOneHeatEstimateAnImage) {
  MissionReport report("fire", at(0));
  report.addHeatEstimate({at(1), {0, 0, 1}, 1.0, 1.1, 5, "place 1"});
  report.addHeatEstimate({at(1), {0, 0, 1}, 1.0, 1.1, 5, "place 1"});
  EXPECT_EQ(nlohmann::json::parse(report.toJson(at(2)))["heat_estimates"].size(), 1U);
}

}  // namespace
}  // namespace kiln
