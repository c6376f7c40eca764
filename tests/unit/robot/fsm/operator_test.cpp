#include <gtest/gtest.h>

#include "tests/unit/robot/fsm/kettle.h"

namespace kiln::kettle {
namespace {

TEST(MachinePause, StopsThePollingAndTheTimeInTheState) {
  Fixture f;
  f.kettle.switched_on = true;
  f.machine.start("", f.clock.now());
  f.run(3.02);  // 3 s in Heat, limit 5 s
  f.machine.pause("teleop", f.clock.now());
  f.run(60.0);
  EXPECT_EQ(f.status().state, "Heat");
  EXPECT_TRUE(f.status().paused);
  EXPECT_EQ(f.status().display_text, "Paused: teleop");
  f.machine.resume(f.clock.now());
  f.run(1.98);
  EXPECT_EQ(f.status().state, "Heat") << "60 s of pause do not count";
  f.run(0.02);
  EXPECT_EQ(f.status().state, "Overheated");
  EXPECT_EQ(f.kettle.calls[3], "Heat.pause");
  EXPECT_EQ(f.kettle.calls[4], "Heat.resume");
}

TEST(MachinePause, TellsHowLongTheStateWasHeld) {
  Fixture f;
  f.machine.start("", f.clock.now());
  f.run(1.0);
  EXPECT_EQ(f.status().paused_in_state, Duration{});
  const auto hold = [&](double seconds) {
    f.machine.pause("operator", f.clock.now());
    f.run(0.5 * seconds);
    const Duration half = *f.status().paused_in_state;
    f.run(0.5 * seconds);
    EXPECT_GT(*f.status().paused_in_state, half) << "while it lasts, too";
    f.machine.resume(f.clock.now());
  };
  hold(20.0);
  f.run(1.0);
  hold(10.0);
  f.run(1.0);
  EXPECT_NEAR(toSeconds(*f.status().paused_in_state), 30.0, 0.1);
  EXPECT_NEAR(toSeconds(timeInState(f.status())), 3.0, 0.1);
  ASSERT_EQ(f.force("Heat").outcome, ChangeStateOutcome::Ok);
  EXPECT_EQ(f.status().paused_in_state, Duration{}) << "another state, another count";
}

TEST(MachinePause, DefersEnterOfAStateForcedMeanwhile) {
  Fixture f;
  f.machine.start("", f.clock.now());
  f.machine.pause("operator", f.clock.now());
  ASSERT_EQ(f.force("Heat").outcome, ChangeStateOutcome::Ok);
  EXPECT_EQ(f.status().state, "Heat");
  EXPECT_EQ(f.kettle.calls.back(), "Idle.leave") << "nothing starts while paused";
  ASSERT_EQ(f.force("Overheated").outcome, ChangeStateOutcome::Ok);
  EXPECT_EQ(f.kettle.calls.back(), "Idle.leave")
      << "Heat was never entered, so it is not left either";
  f.machine.resume(f.clock.now());
  EXPECT_EQ(f.kettle.calls.back(), "Overheated.enter");
}

TEST(MachinePause, EndsWhenATerminalStateIsForced) {
  Fixture f;
  f.machine.start("", f.clock.now());
  f.machine.pause("operator", f.clock.now());
  ASSERT_EQ(f.force("Spilt").outcome, ChangeStateOutcome::Ok);
  EXPECT_TRUE(f.status().terminal && !f.status().paused && !f.status().success);
  EXPECT_EQ(f.kettle.calls.back(), "Spilt.enter");
}

TEST(MachinePause, HoldsAMachineThatDoesNotRunYet) {
  Fixture f;
  f.machine.pause("STOP", f.clock.now());
  f.machine.start("", f.clock.now());
  f.kettle.switched_on = true;
  f.run(1.0);
  EXPECT_TRUE(f.kettle.calls.empty()) << "started, and at the threshold of its first state";
  EXPECT_TRUE(f.status().paused);
  f.machine.resume(f.clock.now());
  EXPECT_EQ(f.kettle.calls.back(), "Idle.enter");
  EXPECT_EQ(f.kettle.arrivals, 1);
}

TEST(MachinePause, HoldsWhatIsForcedAfterTheEnd) {
  Fixture f;
  f.machine.start("", f.clock.now());
  ASSERT_EQ(f.force("Spilt").outcome, ChangeStateOutcome::Ok);
  f.machine.pause("driven by hand", f.clock.now());
  ASSERT_EQ(f.force("Heat").outcome, ChangeStateOutcome::Ok);
  f.run(60.0);
  EXPECT_EQ(f.status().state, "Heat") << "its time limit of 5 s does not run";
  EXPECT_EQ(f.kettle.calls.back(), "Spilt.enter");
  EXPECT_TRUE(f.status().paused);
}

TEST(MachinePause, DoesNotCountTheVisitAgain) {
  Fixture f;
  f.machine.start("", f.clock.now());
  f.machine.pause("operator", f.clock.now());
  f.machine.resume(f.clock.now());
  EXPECT_EQ(f.kettle.arrivals, 1);
}

TEST(ChangeState, NeedsAStartedMission) {
  Fixture f;
  EXPECT_EQ(f.force("Heat").outcome, ChangeStateOutcome::Denied);
}

TEST(ChangeState, AnswersEachOutcome) {
  Fixture f;
  f.machine.start("", f.clock.now());
  EXPECT_EQ(f.force("Boil").outcome, ChangeStateOutcome::NoSuchState);
  EXPECT_EQ(f.force("Pour").outcome, ChangeStateOutcome::NeedsArguments);
  f.kettle.locked = "the lid is open";
  EXPECT_EQ(f.force("Heat").outcome, ChangeStateOutcome::Denied);
  EXPECT_EQ(f.force("Heat").reason, "the lid is open");
  f.kettle.locked.clear();
  EXPECT_EQ(f.force("Heat").outcome, ChangeStateOutcome::Ok);
  EXPECT_EQ(f.status().history.back().cause, TransitionCause::Operator);
  EXPECT_EQ(f.status().history.back().note, "by Ada");
}

TEST(ChangeState, ComparesStepAndNameBeforeItSets) {
  Fixture f;
  f.machine.start("", f.clock.now());
  const FsmStatus seen = f.status();
  f.kettle.switched_on = true;
  f.run(0.02);  // Idle -> Heat behind the operator's back
  const auto moved =
      f.machine.changeState({seen.state, seen.step, "Overheated"}, "Ada", f.clock.now());
  EXPECT_EQ(moved.outcome, ChangeStateOutcome::Moved);
  EXPECT_NE(moved.reason.find("no longer Idle (step 1) but Heat (step 2)"), std::string::npos)
      << moved.reason;
  // The same name at another step is another visit.
  f.kettle.switched_on = false;
  ASSERT_EQ(f.force("Idle").outcome, ChangeStateOutcome::Ok);
  EXPECT_EQ(f.machine.changeState({"Idle", 1, "Heat"}, "Ada", f.clock.now()).outcome,
            ChangeStateOutcome::Moved);
  EXPECT_EQ(f.status().state, "Idle");
}

TEST(ChangeState, RevivesAMissionThatHasEnded) {
  Fixture f;
  f.machine.start("", f.clock.now());
  ASSERT_EQ(f.force("Spilt").outcome, ChangeStateOutcome::Ok);
  EXPECT_FALSE(f.status().running);
  ASSERT_EQ(f.force("Heat").outcome, ChangeStateOutcome::Ok);
  EXPECT_TRUE(f.status().running);
}

}  // namespace
}  // namespace kiln::kettle
