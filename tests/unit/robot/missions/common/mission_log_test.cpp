#include "robot/missions/common/mission_log.h"

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

MissionLog threeStates() {
  MissionLog log;
  log.begin(at(10));
  log.observe(statusWith({{1, "Start", at(10), {}, TransitionCause::Start, ""}}));
  log.observe(statusWith({{1, "Start", at(10), at(12), TransitionCause::Start, ""},
                          {2, "Enter", at(12), {}, TransitionCause::Normal, ""}}));
  // The history has forgotten the first state by now.
  log.observe(statusWith({{2, "Enter", at(12), at(15.5), TransitionCause::Normal, ""},
                          {3, "Finished", at(15.5), {}, TransitionCause::Operator, "by Ann"}}));
  return log;
}

TEST(MissionLog, CollectsEveryStateThoughTheHistoryIsBounded) {
  const MissionLog log = threeStates();
  ASSERT_EQ(log.states().size(), 3U);
  EXPECT_EQ(log.states()[0].left, at(12));
  EXPECT_EQ(log.states()[1].state, "Enter");
  EXPECT_EQ(log.states()[1].left, at(15.5));
  EXPECT_EQ(log.states()[2].left, Stamp{}) << "the current state has not been left";
  EXPECT_EQ(log.states()[2].cause, TransitionCause::Operator);
}

TEST(MissionLog, ComesBackShifted) {
  MissionLog back;
  const auto saved = nlohmann::json::parse(threeStates().save().dump());
  ASSERT_TRUE(back.restore(saved, at(20), fromSeconds(-8)).has_value());
  EXPECT_EQ(back.begun(), at(2));
  ASSERT_EQ(back.states().size(), 3U);
  EXPECT_EQ(back.states()[1].left, at(7.5));
  EXPECT_EQ(back.states()[2].left, at(12)) << "left when the program ended";
  EXPECT_EQ(back.states()[2].note, "by Ann");
}

TEST(MissionLog, RefusesWhatIsDamaged) {
  MissionLog log = threeStates();
  auto unknown_cause = log.save();
  unknown_cause["states"][0][4] = 17;
  EXPECT_FALSE(log.restore(unknown_cause, at(20), {}).has_value());
  EXPECT_FALSE(log.restore({{"begun_ns", "now"}}, at(20), {}).has_value());
  EXPECT_EQ(log.states().size(), 3U) << "nothing was taken over";
}

}  // namespace
}  // namespace kiln
