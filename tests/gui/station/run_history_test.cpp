#include "gui/link/run_history.h"

#include <gtest/gtest.h>

namespace kiln::gui {
namespace {

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

class RunHistoryTest : public testing::Test {
 protected:
  RunHistoryTest() {
    MissionInfo info;
    FigureSpec peak;
    peak.id = "peak";
    peak.unit = "°C";
    peak.plot = true;
    FigureSpec duty;
    duty.id = "fan.duty";
    duty.label = "Fan";
    duty.high = 1.0;
    info.figures = {peak, duty};
    run.setMission(info);
  }
  /// From `from` to `to` in steps of a tenth of a second.
  void tell(double from, double to) {
    for (int i = 0; from + 0.1 * i <= to + 1e-9; ++i) {
      status.stamp = at(from + 0.1 * i);
      run.add(status);
      run.addAlarms(status.stamp, status.alarms);
    }
  }
  RunHistory run;
  RobotStatus status;
};

TEST_F(RunHistoryTest, EachChangeBeginsASpan) {
  status.word = StatusWord::Auto;
  tell(10, 12);
  status.word = StatusWord::Stopped;
  status.stop.latched = true;
  status.stop.source = "Ann";
  status.macro.running = "arm park";
  tell(12.1, 15);
  status.stop.latched = false;
  status.word = StatusWord::Teleop;
  status.figures = {{"fan.duty", 0.4}, {"peak", 90.0}};
  tell(15.1, 20);
  const auto& mode = run.lane(RunHistory::Mode);
  ASSERT_EQ(mode.size(), 3U);
  EXPECT_EQ(mode[0].text, "AUTO");
  EXPECT_EQ(mode[1].look, SpanLook::Fault);
  EXPECT_EQ(mode[0].to, mode[1].from) << "no hole between two neighbours";
  EXPECT_EQ(mode[2].look, SpanLook::Manual);
  const auto& stop = run.lane(RunHistory::Stop);
  ASSERT_EQ(stop.size(), 1U);
  EXPECT_EQ(stop[0].text, "STOP by Ann");
  EXPECT_NEAR(toSeconds(stop[0].to - stop[0].from), 3.0, 1e-6);
  ASSERT_EQ(run.lane(RunHistory::Macros).size(), 1U);
  ASSERT_EQ(run.lane(RunHistory::Actuators).size(), 1U);
  EXPECT_EQ(run.lane(RunHistory::Actuators)[0].text, "Fan");
  EXPECT_EQ(spanAt(mode, at(13.0)), &mode[1]);
  EXPECT_EQ(spanAt(mode, at(9.0)), nullptr);
  EXPECT_EQ(sampleAt(run.figure("peak"), at(16.0), 1.0), 90.0);
  EXPECT_FALSE(sampleAt(run.figure("peak"), at(12.0), 1.0)) << "not known then";
}

TEST_F(RunHistoryTest, NothingIsKnownOfATimeInWhichTheRobotWasNotHeard) {
  status.word = StatusWord::Auto;
  tell(10, 12);
  tell(20, 22);
  const auto& mode = run.lane(RunHistory::Mode);
  ASSERT_EQ(mode.size(), 2U);
  EXPECT_EQ(mode[0].to, at(12));
  EXPECT_EQ(mode[1].from, at(20));
  EXPECT_EQ(spanAt(mode, at(15)), nullptr);
}

TEST_F(RunHistoryTest, TheHeaviestAlarmStandsForTheOthers) {
  status.alarms = {{"a", AlarmLevel::Caution, "camera frozen 1 s", "look", at(10)}};
  tell(10, 12);
  status.alarms[0].text = "camera frozen 3 s";  // the same alarm goes on
  tell(12.1, 13);
  status.alarms.push_back({"b", AlarmLevel::Warning, "arm stands", "look", at(13)});
  tell(13.1, 14);
  status.alarms[1].active = false;
  tell(14.1, 15);
  const auto& alarms = run.lane(RunHistory::Alarms);
  ASSERT_EQ(alarms.size(), 3U);
  EXPECT_EQ(alarms[0].text, "camera frozen 1 s");
  EXPECT_EQ(alarms[1].text, "arm stands and 1 more");
  EXPECT_EQ(alarms[1].look, SpanLook::Fault);
  EXPECT_EQ(alarms[2].look, SpanLook::Caution);
}

TEST_F(RunHistoryTest, CommandsGetTheirAnswersAndSetpointsAreNone) {
  Command command{"me", "Ann", 7, 1, at(10), 0, Pause{}};
  run.add(command);
  command.nonce = 8;
  command.body = JogBase{};
  run.add(command);
  run.add(CommandAck{"me", 7, "pause", AckOutcome::Refused, "no", "not now"});
  run.add(CommandAck{"other", 7, "pause", AckOutcome::Done});
  ASSERT_EQ(run.commands().size(), 1U);
  EXPECT_EQ(run.commands()[0].outcome, AckOutcome::Refused);
  EXPECT_EQ(run.commands()[0].reason, "not now");
}

TEST_F(RunHistoryTest, ForgetsWhatIsOldButNotWhatGoesOn) {
  status.word = StatusWord::Auto;
  tell(1, 10);
  status.word = StatusWord::Teleop;
  tell(10.1, 30);
  run.forgetBefore(at(20));
  ASSERT_EQ(run.lane(RunHistory::Mode).size(), 1U);
  EXPECT_EQ(run.lane(RunHistory::Mode)[0].text, "TELEOP");
  EXPECT_GE(run.armForceN().front().stamp, at(20));
}

TEST_F(RunHistoryTest, CountsHowLongTheMachineWasHeld) {
  FsmStatus fsm;
  fsm.state = "Drive";
  fsm.running = true;
  for (int i = 0; i <= 100; ++i) {
    fsm.stamp = at(0.1 * i);
    fsm.paused = i >= 20 && i < 50;
    run.add(fsm);
  }
  EXPECT_NEAR(toSeconds(run.paused(at(0), at(10))), 3.0, 0.11);
  EXPECT_NEAR(toSeconds(run.paused(at(4), at(10))), 1.0, 0.11);
  EXPECT_EQ(run.paused(at(6), at(10)), Duration{});
}

TEST(VisitLog, AMissionAfterAnotherCountsItsStepsAnew) {
  VisitLog log;
  FsmStatus fsm;
  for (const auto& [uuid, step, state] : std::vector<std::tuple<std::string, int, std::string>>{
           {"a", 1, "Drive"}, {"a", 2, "Look"}, {"b", 1, "Drive"}, {"b", 2, "Spray"}}) {
    fsm.stamp = fsm.stamp + fromSeconds(1.0);
    fsm.mission_uuid = uuid;
    fsm.step = static_cast<std::uint64_t>(step);
    fsm.state = state;
    fsm.entered = fsm.stamp;
    log.add(fsm);
  }
  ASSERT_EQ(log.visits().size(), 4U);
  EXPECT_EQ(log.visits()[3].state, "Spray");
  for (std::size_t i = 0; i + 1 < 4; ++i) EXPECT_NE(log.visits()[i].left, Stamp{});
  EXPECT_EQ(log.visits()[3].left, Stamp{});
}

}  // namespace
}  // namespace kiln::gui
