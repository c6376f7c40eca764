#include <gtest/gtest.h>

#include "tests/unit/robot/fsm/kettle.h"

namespace kiln::kettle {
namespace {

TEST(FsmCheckpoint, IsTakenAfterEachTransition) {
  Fixture f;
  std::vector<FsmCheckpoint> taken;
  f.machine.onTransition([&taken](const FsmCheckpoint& c) { taken.push_back(c); });
  f.kettle.switched_on = f.kettle.boils = true;
  f.machine.start("", f.clock.now());
  f.run(3.0);
  ASSERT_EQ(taken.size(), 4u);
  EXPECT_EQ(taken[1].state, "Heat");
  EXPECT_EQ(taken[1].resume_state, "Heat");
  EXPECT_EQ(taken[2].state, "Pour");
  EXPECT_EQ(taken[2].resume_state, "Heat") << "Pour needs arguments";
  EXPECT_EQ(taken[3].step, 4u);
}

TEST(FsmCheckpoint, RestoreGoesOnUnderTheSameUuidAndCounter) {
  Fixture f;
  const Result<void> restored =
      f.machine.restore({"kettle", "uuid-old", 17, "Pour", "Heat"}, f.clock.now());
  ASSERT_TRUE(restored.has_value()) << restored.error();
  const FsmStatus status = f.status();
  EXPECT_EQ(status.state, "Heat");
  EXPECT_EQ(status.step, 18u);
  EXPECT_EQ(status.mission_uuid, "uuid-old");
  EXPECT_TRUE(status.running);
  EXPECT_EQ(status.history.back().cause, TransitionCause::Resume);
  EXPECT_TRUE(status.paused) << "it stands; nothing moves before somebody lets go";
  EXPECT_TRUE(f.kettle.calls.empty());
  f.run(1.0);
  EXPECT_TRUE(f.kettle.calls.empty());
  f.machine.resume(f.clock.now());
  EXPECT_EQ(f.kettle.calls, std::vector<std::string>{"Heat.enter"}) << "entered once, not counted";
}

/// Forced while the machine was held, killed before it was let go.
TEST(FsmCheckpoint, RestoreCountsAVisitThatHadNotBegun) {
  Fixture held;
  held.machine.start("", held.clock.now());
  held.machine.pause("test", held.clock.now());
  const FsmStatus seen = held.status();
  (void)held.machine.changeState({seen.state, seen.step, "Heat"}, "Ann", held.clock.now());
  const FsmCheckpoint taken = held.machine.checkpoint();
  EXPECT_FALSE(taken.arrived);
  Fixture f;
  ASSERT_TRUE(f.machine.restore(taken, f.clock.now()).has_value());
  EXPECT_FALSE(f.machine.checkpoint().arrived);
  f.machine.resume(f.clock.now());
  EXPECT_EQ(f.kettle.arrivals, 1);
  EXPECT_TRUE(f.machine.checkpoint().arrived);
}

TEST(FsmCheckpoint, RestoreAsksWhetherTheStateMayBeEntered) {
  Fixture f;
  f.kettle.locked = "the lid is open";
  ASSERT_TRUE(f.machine.restore({"kettle", "u", 5, "Pour", "Heat"}, f.clock.now()).has_value());
  EXPECT_EQ(f.status().state, "Idle") << "the start state takes its place";
  EXPECT_NE(f.status().history.back().note.find("the lid is open"), std::string::npos);
}

TEST(FsmCheckpoint, RestoreOfAnEndedMissionStaysEnded) {
  Fixture f;
  ASSERT_TRUE(f.machine.restore({"kettle", "u", 5, "Served", "Served"}, f.clock.now()).has_value());
  EXPECT_FALSE(f.status().running);
  EXPECT_TRUE(f.status().success);
}

TEST(FsmCheckpoint, RestoreRefusesWhatItDoesNotKnow) {
  Fixture f;
  EXPECT_FALSE(f.machine.restore({"wall", "u", 5, "Heat", "Heat"}, f.clock.now()).has_value());
  const auto unknown = f.machine.restore({"kettle", "u", 5, "Steam", "Steam"}, f.clock.now());
  ASSERT_FALSE(unknown.has_value());
  EXPECT_EQ(unknown.error().code, ErrorCode::VersionMismatch);
  EXPECT_FALSE(f.status().running) << "a refused checkpoint starts nothing";
}

TEST(FsmRestart, GoesBackToTheStartWithinTheMission) {
  Fixture f;
  f.kettle.switched_on = true;
  f.machine.start("", f.clock.now());
  f.run(1.0);
  f.kettle.switched_on = false;
  f.machine.restart("reset 1", f.clock.now());
  EXPECT_EQ(f.status().state, "Idle");
  EXPECT_EQ(f.status().step, 3u);
  EXPECT_EQ(f.status().history.back().note, "reset 1");
}

}  // namespace
}  // namespace kiln::kettle
