#include <algorithm>

#include <gtest/gtest.h>

#include "tests/unit/robot/fsm/kettle.h"

namespace kiln::kettle {
namespace {

using Calls = std::vector<std::string>;

TEST(Machine, DescribesItsGraph) {
  Fixture f;
  const FsmInfo info = f.machine.info();
  EXPECT_EQ(info.mission, "kettle");
  EXPECT_EQ(info.mission_uuid, "uuid-1");
  EXPECT_EQ(info.start_state, "Idle");
  ASSERT_EQ(info.states.size(), 6u);
  EXPECT_EQ(info.states[1].name, "Heat");
  EXPECT_EQ(info.states[1].time_limit_s, 5.0);
  EXPECT_EQ(info.states[1].timeout_target, "Overheated");
  EXPECT_FALSE(info.states[2].enterable);
  EXPECT_NE(info.states[2].not_enterable_reason.find("cannot be entered by hand"),
            std::string::npos);
  EXPECT_TRUE(info.states[4].terminal && info.states[4].success);
  EXPECT_TRUE(info.states[5].terminal && !info.states[5].success);
  ASSERT_EQ(info.edges.size(), 5u);
  EXPECT_EQ(info.edges[0].from, "Idle");
  EXPECT_EQ(info.edges[0].to, "Heat");
  EXPECT_EQ(info.edges[0].consequence, "the plate turns on");
  EXPECT_TRUE(info.edges[2].timeout) << "Heat -> Overheated";
}

TEST(Machine, PutsClassNamesIntoWords) {
  EXPECT_EQ(fsm_detail::inWords("AimHose"), "Aim hose");
  EXPECT_EQ(fsm_detail::typeName<Overheated>(), "Overheated");
}

TEST(Machine, DoesNothingBeforeItsStart) {
  Fixture f;
  f.run(1.0);
  f.machine.pause("why not", f.clock.now());
  EXPECT_TRUE(f.kettle.calls.empty());
  EXPECT_FALSE(f.status().running);
  EXPECT_EQ(f.status().state, "");
}

TEST(Machine, CallsEnterLeaveAndCountsSteps) {
  Fixture f;
  f.machine.start("", f.clock.now());
  f.machine.start("", f.clock.now());  // a second start changes nothing
  EXPECT_EQ(f.status().step, 1u);
  f.kettle.switched_on = true;
  f.run(0.02);
  EXPECT_EQ(f.status().state, "Heat");
  f.kettle.boils = true;
  f.run(0.02);
  EXPECT_EQ(f.kettle.calls,
            (Calls{"Idle.enter", "Idle.leave", "Heat.enter", "Heat.leave", "Pour.enter"}));
  f.run(2.0);
  const FsmStatus status = f.status();
  EXPECT_EQ(status.state, "Served");
  EXPECT_EQ(status.step, 4u);
  EXPECT_TRUE(status.terminal && status.success && !status.running);
}

TEST(Machine, ShowsGuardsWithTheAgeOfTheirInput) {
  Fixture f;
  f.machine.start("", f.clock.now());
  f.run(0.02);
  f.clock.advanceBy(std::chrono::milliseconds(500));
  const FsmStatus status = f.status();
  ASSERT_EQ(status.guards.size(), 1u);
  EXPECT_EQ(status.guards[0].name, "Switched on");
  EXPECT_FALSE(status.guards[0].met);
  EXPECT_NEAR(status.guards[0].input_age_s, 0.8, 1e-9) << "0.3 s when judged, 0.5 s ago";
  EXPECT_EQ(status.display_text, "waiting for the switch");
}

TEST(Machine, LeavesOnTimeOut) {
  Fixture f;
  f.machine.start("", f.clock.now());
  f.kettle.switched_on = true;
  f.run(0.02);
  f.run(4.98);
  EXPECT_EQ(f.status().state, "Heat");
  f.run(0.02);
  EXPECT_EQ(f.status().state, "Overheated");
  EXPECT_EQ(f.status().history.back().cause, TransitionCause::Timeout);
  EXPECT_EQ(f.status().history.back().note, "Heat took longer than 5 s");
}

TEST(Machine, WatchRunsBeforeExecute) {
  Fixture f;
  f.kettle.switched_on = f.kettle.boils = true;
  f.machine.start("", f.clock.now());
  f.run(0.04);
  ASSERT_EQ(f.status().state, "Pour");
  f.kettle.alarm = true;
  f.run(0.02);
  EXPECT_EQ(f.status().state, "Served");
  EXPECT_EQ(f.status().history.back().note, "alarm");
  EXPECT_EQ(std::count(f.kettle.calls.begin(), f.kettle.calls.end(), "Pour.execute"), 0);
}

TEST(Machine, KeepsABoundedHistoryWithTimes) {
  Fixture f;
  f.machine.start("", f.clock.now());
  for (int i = 0; i < 20; ++i) {
    f.run(0.1);
    EXPECT_EQ(f.force(i % 2 == 0 ? "Heat" : "Idle").outcome, ChangeStateOutcome::Ok);
  }
  const FsmStatus status = f.status();
  ASSERT_EQ(status.history.size(), 8u);
  EXPECT_EQ(status.history.back().step, 21u);
  EXPECT_EQ(status.history.back().left, Stamp{});
  const FsmHistoryEntry& before = status.history[6];
  EXPECT_EQ(before.left, status.history.back().entered);
  EXPECT_NEAR(toSeconds(before.left - before.entered), 0.1, 1e-9);
}

}  // namespace
}  // namespace kiln::kettle
