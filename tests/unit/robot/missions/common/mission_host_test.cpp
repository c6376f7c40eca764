#include "robot/missions/common/mission_host.h"

#include <gtest/gtest.h>

#include "tests/support/machine_mission.h"
#include "tests/unit/robot/fsm/kettle.h"

namespace kiln::kettle {
namespace {

/// The kettle's machine under a host.
struct Desk : Fixture {
  StopLatch stop;
  MachineMission mission{machine};
  RobotBelief belief;
  MissionHost host{mission, belief, stop, clock};
  Desk() { kettle.switched_on = false; }
  [[nodiscard]] Stamp now() const { return clock.now(); }
  void begin() {
    host.start(now());
    run(0.1);
  }
  void press() {
    (void)stop.set("Ann", now());
    (void)host.observeStop(now());
  }
  /// A checkpoint of a mission that stood in `state`.
  [[nodiscard]] MissionCheckpoint saved(const std::string& state = "Idle") const {
    MissionCheckpoint out = host.checkpoint();
    out.fsm = {"kettle", "u", 5, state, state};
    return out;
  }
  Result<void> restore(std::vector<MissionHold> holds, const std::string& state = "Idle") {
    MissionCheckpoint checkpoint = saved(state);
    checkpoint.holds = std::move(holds);
    const auto read = decodeCheckpoint(encodeCheckpoint(checkpoint), "f");
    return read ? host.restore(*read, now()) : tl::make_unexpected(read.error());
  }
  [[nodiscard]] bool clear() { return host.clearStop(stop.generation(), now()); }
  /// Whether a second changes anything that the machine does.
  [[nodiscard]] bool moves() {
    const auto calls = kettle.calls.size();
    kettle.switched_on = true;
    run(1.0);
    host.check();
    return kettle.calls.size() != calls;
  }
};

TEST(MissionHost, GoesThroughItsPhases) {
  Desk d;
  EXPECT_EQ(d.host.phase(), MissionPhase::Idle);
  d.host.waitForStart();
  EXPECT_EQ(d.host.phase(), MissionPhase::Waiting);
  d.begin();
  EXPECT_EQ(d.host.phase(), MissionPhase::Running);
  EXPECT_EQ(d.host.word(true), StatusWord::Auto);
  d.host.hold(HoldReason::OperatorPause, "paused by Ann", d.now());
  EXPECT_EQ(d.host.phase(), MissionPhase::Held);
  EXPECT_EQ(d.host.word(true), StatusWord::Paused);
  EXPECT_EQ(d.host.reason(), "paused by Ann");
  d.host.resume(d.now());
  EXPECT_EQ(d.host.phase(), MissionPhase::Running);
  ASSERT_EQ(d.force("Spilt").outcome, ChangeStateOutcome::Ok);
  EXPECT_EQ(d.host.phase(), MissionPhase::Ended);
  EXPECT_EQ(d.host.word(true), StatusWord::Ready);
  d.begin();
  EXPECT_EQ(d.host.phase(), MissionPhase::Running);
  EXPECT_EQ(d.host.starts(), 2);
}

// B1: STOP before the start, cleared before or after the checks pass.
TEST(MissionHost, AStopEndsTheWaitingForAStart) {
  Desk d;
  d.host.waitForStart();
  d.press();
  EXPECT_EQ(d.host.waiting(), MissionHost::Wait::None);
  EXPECT_EQ(d.host.mode(), Mode::Stopped);
  ASSERT_TRUE(d.clear());
  EXPECT_EQ(d.host.phase(), MissionPhase::Idle);
  EXPECT_FALSE(d.moves());
  d.begin();
  EXPECT_EQ(d.host.phase(), MissionPhase::Running) << "a start by hand is a new act";
}

TEST(MissionHost, AStopEndsTheWaitingForAResume) {
  Desk d;
  ASSERT_TRUE(d.restore({}).has_value());
  EXPECT_EQ(d.host.phase(), MissionPhase::Waiting);
  EXPECT_FALSE(d.moves());
  d.press();
  ASSERT_TRUE(d.clear());
  EXPECT_EQ(d.host.phase(), MissionPhase::Held);
  EXPECT_FALSE(d.moves());
  d.host.resume(d.now());
  EXPECT_TRUE(d.moves());
}

TEST(MissionHost, TeleopEndsTheWaiting) {
  Desk d;
  d.host.waitForStart();
  d.host.enterTeleop("Ann", d.now());
  EXPECT_EQ(d.host.waiting(), MissionHost::Wait::None);
  EXPECT_EQ(d.host.word(true), StatusWord::Teleop);
  d.host.leaveTeleop("Ann", d.now());
  EXPECT_EQ(d.host.mode(), Mode::None);
  EXPECT_EQ(d.host.phase(), MissionPhase::Idle);
  EXPECT_FALSE(d.machine.held()) << "and nothing stands in the way of a start";
}

// B2: leaving Teleop forgets neither Pause, nor STOP, nor a lost position, and drives nothing.
TEST(MissionHost, LeavingTeleopMovesNothing) {
  for (const HoldReason reason :
       {HoldReason::OperatorPause, HoldReason::PositionLost, HoldReason::Teleop}) {
    Desk d;
    d.begin();
    if (reason != HoldReason::Teleop) d.host.hold(reason, "why", d.now());
    d.host.enterTeleop("Ann", d.now());
    d.host.leaveTeleop("Ann", d.now());
    EXPECT_EQ(d.host.mode(), Mode::Autonomous);
    EXPECT_EQ(d.host.phase(), MissionPhase::Held);
    EXPECT_FALSE(d.moves());
    d.host.resume(d.now());
    EXPECT_TRUE(d.moves());
  }
}

// B3: forced after the end, in Teleop.
TEST(MissionHost, AForcedStateInTeleopWaits) {
  Desk d;
  d.begin();
  ASSERT_EQ(d.force("Spilt").outcome, ChangeStateOutcome::Ok);
  d.host.enterTeleop("Ann", d.now());
  const FsmStatus seen = d.status();
  ASSERT_EQ(d.host.force({seen.state, seen.step, "Idle"}, "Ann", d.now()).outcome,
            ChangeStateOutcome::Ok);
  EXPECT_EQ(d.host.phase(), MissionPhase::Held);
  EXPECT_FALSE(d.moves());
  d.host.leaveTeleop("Ann", d.now());
  EXPECT_FALSE(d.moves());
}

// B4: a STOP that was acknowledged cannot be erased by a clear that was on its way.
TEST(MissionHost, AClearEndsOnlyTheStopThatItNames) {
  Desk d;
  d.begin();
  d.press();
  const auto seen = d.stop.generation();
  (void)d.stop.set("Ben", d.now());
  EXPECT_FALSE(d.host.clearStop(seen, d.now()));
  EXPECT_TRUE(d.stop.latched());
  EXPECT_TRUE(d.host.observeStop(d.now())) << "each STOP is told once";
  EXPECT_FALSE(d.host.observeStop(d.now()));
  ASSERT_TRUE(d.clear());
  EXPECT_EQ(d.host.phase(), MissionPhase::Held);
  EXPECT_FALSE(d.moves());
}

TEST(MissionHost, WhatHeldItBeforeARestartHoldsItAfter) {
  Desk d;
  ASSERT_TRUE(
      d.restore({{HoldReason::Stop, "STOP by Ann"}, {HoldReason::Teleop, "Ann drives by hand"}})
          .has_value());
  EXPECT_TRUE(d.stop.latched());
  EXPECT_EQ(d.host.waiting(), MissionHost::Wait::None);
  EXPECT_TRUE(d.host.observeStop(d.now()));
  EXPECT_FALSE(d.moves());
  ASSERT_TRUE(d.clear());
  EXPECT_EQ(d.host.phase(), MissionPhase::Held);
  EXPECT_FALSE(d.moves());
  d.host.resume(d.now());
  EXPECT_TRUE(d.moves());
}

TEST(MissionHost, WhatHadEndedBeforeARestartHasEnded) {
  Desk d;
  ASSERT_TRUE(d.restore({}, "Served").has_value());
  d.host.check();
  EXPECT_EQ(d.host.phase(), MissionPhase::Ended);
}

// The report of a mission knows what was before a kill.
TEST(MissionHost, ItsLogAndClockGoOnAfterARestart) {
  Desk before;
  before.begin();
  before.host.tick(before.now());
  const Stamp begun = before.host.log().begun();
  const MissionCheckpoint kept = before.host.checkpoint();
  Desk after;
  after.clock.advanceBy(std::chrono::seconds(7));
  ASSERT_TRUE(after.host.restore(kept, after.now()).has_value());
  after.host.resume(after.now());
  after.host.tick(after.now());
  EXPECT_EQ(after.host.log().begun(), begun);
  EXPECT_NEAR(after.belief.elapsedS(after.now()), 7.0, 1.0);
  const auto& states = after.host.log().states();
  ASSERT_EQ(states.size(), 2U) << "as it stood, and resumed";
  EXPECT_EQ(states[0].entered, begun);
  EXPECT_EQ(states[0].left, kept.stamp) << "it did not last while the program was dead";
  EXPECT_EQ(states[1].cause, TransitionCause::Resume);
  EXPECT_EQ(after.status().mission_uuid, before.status().mission_uuid);
}

// Robot time began anew: stamps of before are moved, lengths stay.
TEST(MissionHost, ItsLogSurvivesARestartOfTheComputer) {
  Desk before;
  before.clock.advanceBy(std::chrono::seconds(500));
  before.begin();
  before.run(3.0);
  before.host.tick(before.now());
  Desk after;
  const MissionCheckpoint kept = before.host.checkpoint();
  ASSERT_LT(after.now(), kept.stamp);
  ASSERT_TRUE(after.host.restore(kept, after.now()).has_value());
  EXPECT_EQ(after.now() - after.host.log().begun(), kept.stamp - before.host.log().begun());
  EXPECT_NEAR(after.belief.elapsedS(after.now()), before.belief.elapsedS(before.now()), 0.1);
}

TEST(MissionHost, RefusesAnotherMissionsCheckpoint) {
  Desk d;
  MissionCheckpoint other = d.saved();
  other.fsm.mission = "teapot";
  const auto refused = d.host.restore(other, d.now());
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("teapot"), std::string::npos);
}

TEST(MissionHost, AResetBeginsTheStatesAnewAndKeepsTheClock) {
  Desk d;
  d.begin();
  d.run(2.0);
  const double elapsed_s = d.belief.elapsedS(d.now());
  d.host.hold(HoldReason::OperatorPause, "pause", d.now());
  d.host.onReset(d.now());
  EXPECT_EQ(d.belief.resets, 1);
  EXPECT_GE(d.belief.elapsedS(d.now()), elapsed_s);
  EXPECT_EQ(d.host.phase(), MissionPhase::Held) << "and moves nothing by itself";
  EXPECT_FALSE(d.moves());
}

TEST(MissionHost, ASecondStartIsAnotherMission) {
  Desk d;
  d.begin();
  d.run(2.0);
  const std::string first = d.status().mission_uuid;
  ASSERT_EQ(d.force("Spilt").outcome, ChangeStateOutcome::Ok);
  d.begin();
  EXPECT_NE(d.status().mission_uuid, first);
  EXPECT_LT(d.belief.elapsedS(d.now()), 1.0) << "its clock begins anew";
  d.host.tick(d.now());
  EXPECT_EQ(d.host.log().states().front().cause, TransitionCause::Start);
}

TEST(MissionHost, NamesEachReason) {
  Desk d;
  d.begin();
  d.host.hold(HoldReason::PositionLost, "position lost", d.now());
  d.host.enterTeleop("Ann", d.now());
  d.press();
  const auto holds = d.host.holds();
  ASSERT_EQ(holds.size(), 3u);
  EXPECT_EQ(holds[0].reason, HoldReason::Teleop);
  EXPECT_EQ(holds[1].reason, HoldReason::Stop);
  EXPECT_EQ(holds[2].reason, HoldReason::PositionLost);
  EXPECT_EQ(d.host.reason(), "STOP by Ann");
}

}  // namespace
}  // namespace kiln::kettle
