#include "gui/models/forced_jump.h"

#include <gtest/gtest.h>

#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

class ForcedJumpTest : public testing::Test {
 protected:
  ForcedJumpTest() {
    station.pass(2.0);
    station.takeLease();
    station.startMission();
    EXPECT_EQ(station.models.fsm.current(), "EnterBuilding");
  }
  /// Every ChangeState that left the station.
  [[nodiscard]] std::vector<ChangeState> jumps() const {
    std::vector<ChangeState> out;
    for (const CommandBody& body : station.link.sent()) {
      if (const auto* change = std::get_if<ChangeState>(&body)) out.push_back(*change);
    }
    return out;
  }
  SteppedStation station;
  ForcedJump jump{station.models};
};

TEST_F(ForcedJumpTest, CarriesTheStateAndStepThatTheOperatorSaw) {
  ASSERT_TRUE(jump.arm());
  ASSERT_TRUE(jump.pick("SafeStop"));
  EXPECT_TRUE(jumps().empty()) << "nothing may be sent before the hold";
  const std::uint64_t step = station.models.fsm.status()->step;
  jump.confirm();
  ASSERT_EQ(jumps().size(), 1U);
  EXPECT_EQ(jumps()[0].from, "EnterBuilding");
  EXPECT_EQ(jumps()[0].to, "SafeStop");
  EXPECT_EQ(jumps()[0].step, step);
  EXPECT_EQ(jump.phase(), ForcedJump::Phase::Sent);
  station.settle();
  EXPECT_EQ(jump.phase(), ForcedJump::Phase::Answered);
  EXPECT_FALSE(jump.failed());
  EXPECT_EQ(station.models.fsm.current(), "SafeStop");
}

TEST_F(ForcedJumpTest, RefusesAStateThatNeedsArgumentsWithItsReason) {
  ASSERT_TRUE(jump.arm());
  EXPECT_FALSE(jump.pick("DriveBlocked"));
  EXPECT_TRUE(jump.message().contains("needs data")) << jump.message().toStdString();
  EXPECT_EQ(jump.phase(), ForcedJump::Phase::Armed);
}

TEST_F(ForcedJumpTest, DisarmsAfterFiveSecondsWithoutAStep) {
  ASSERT_TRUE(jump.arm());
  station.pass(4.8);
  EXPECT_EQ(jump.phase(), ForcedJump::Phase::Armed);
  station.pass(0.4);
  EXPECT_NE(jump.phase(), ForcedJump::Phase::Armed);
  jump.confirm();
  EXPECT_TRUE(jumps().empty());
}

TEST_F(ForcedJumpTest, CancelsWhenTheRobotMovesOnUnderThePick) {
  station.pass(8.0);  // EnterBuilding lasts 10.8 s or more
  ASSERT_TRUE(jump.pick("SafeStop"));
  while (station.models.fsm.current() == "EnterBuilding") station.pass(0.5);
  EXPECT_EQ(jump.phase(), ForcedJump::Phase::Answered);
  EXPECT_TRUE(jump.failed());
  jump.confirm();
  EXPECT_TRUE(jumps().empty());
}

TEST_F(ForcedJumpTest, ShowsTheRobotsRefusalWhenItHasMovedUnseen) {
  ASSERT_TRUE(jump.pick("SafeStop"));
  // The robot leaves the state without the station having heard of it yet.
  station.link.robot().send(
      DirectLink::kClient, "Ann",
      ChangeState{"EnterBuilding", station.models.fsm.status()->step, "SafeStop"});
  jump.confirm();
  station.settle();
  EXPECT_TRUE(jump.failed());
  EXPECT_TRUE(jump.message().startsWith("refused")) << jump.message().toStdString();
  EXPECT_EQ(station.models.fsm.current(), "SafeStop");
}

TEST_F(ForcedJumpTest, NeedsTheLease) {
  station.models.lease.release();
  station.settle();
  EXPECT_FALSE(jump.arm());
  EXPECT_TRUE(jump.failed());
  EXPECT_TRUE(jump.message().contains("lease"));
}

TEST_F(ForcedJumpTest, EscapeCancels) {
  ASSERT_TRUE(jump.pick("SafeStop"));
  jump.cancel();
  EXPECT_EQ(jump.phase(), ForcedJump::Phase::Idle);
  jump.confirm();
  EXPECT_TRUE(jumps().empty());
}

}  // namespace
}  // namespace kiln::gui
