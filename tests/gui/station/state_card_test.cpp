#include "gui/views/state_card/state_card.h"

#include <QLabel>
#include <QTest>
#include <algorithm>

#include <gtest/gtest.h>

#include "gui/views/fsm_graph/fsm_tile.h"
#include "gui/views/fsm_graph/graph_view.h"
#include "gui/views/fsm_graph/jump_panel.h"
#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

class StateCardTest : public testing::Test {
 protected:
  StateCardTest() {
    station.pass(2.0);
    station.takeLease();
    tile.resize(360, 520);
    tile.show();
    card.resize(360, 300);
    card.show();
  }
  void hold(HoldButton* button, double seconds) {
    QTest::mousePress(button, Qt::LeftButton);
    station.link.advance(seconds);
    button->tick();
    QTest::mouseRelease(button, Qt::LeftButton);
    station.settle();
  }
  SteppedStation station;
  Theme theme;
  Ui ui{theme, station.link.clock()};
  ForcedJump jump{station.models};
  FsmTile tile{ui, station.models, jump};
  StateCard card{ui, station.models, jump};
};

TEST_F(StateCardTest, ShowsTheChecksWhileNotReady) {
  RobotStatus status = *station.models.status.status();
  status.word = StatusWord::NotReady;
  status.checks = {{"Disk", true, "41 GB free"},
                   {"LiDAR", false, "no scan yet", "check its cable and power"}};
  emit station.link.status(std::make_shared<const RobotStatus>(status));
  station.settle();
  ASSERT_TRUE(card.preflight()->isVisible());
  EXPECT_EQ(card.preflight()->total(), 2);
  EXPECT_EQ(card.preflight()->failing(), 1);
  const int with_action = card.preflight()->heightForWidth(300);
  status.checks[1].action.clear();
  emit station.link.status(std::make_shared<const RobotStatus>(status));
  station.settle();
  EXPECT_LT(card.preflight()->heightForWidth(300), with_action) << "what to do needs a line";
  status.word = StatusWord::Auto;
  emit station.link.status(std::make_shared<const RobotStatus>(status));
  station.settle();
  EXPECT_TRUE(card.preflight()->isHidden());
}

TEST_F(StateCardTest, AWarningIsShownThoughTheRobotIsReady) {
  RobotStatus status = *station.models.status.status();
  status.word = StatusWord::Ready;
  status.checks = {{"LiDAR", true, "0.05 s old"}, {"Disk", true, "1.0 GB free", "make room", true}};
  emit station.link.status(std::make_shared<const RobotStatus>(status));
  station.settle();
  ASSERT_TRUE(card.preflight()->isVisible());
  EXPECT_EQ(card.preflight()->failing(), 0);
  EXPECT_EQ(card.preflight()->warning(), 1);
}

TEST_F(StateCardTest, OffersTheReleaseOfAProtectiveStopOnlyInOne) {
  EXPECT_FALSE(card.protectiveRelease()->isVisible());
  RobotStatus status = *station.models.status.status();
  status.arm.safety = ArmSafetyMode::ProtectiveStop;
  emit station.link.status(std::make_shared<const RobotStatus>(status));
  station.settle();
  ASSERT_TRUE(card.protectiveRelease()->isVisible());
  QTest::mousePress(card.protectiveRelease(), Qt::LeftButton);
  station.link.advance(0.0);
  QTest::mouseRelease(card.protectiveRelease(), Qt::LeftButton);
  for (const CommandBody& body : station.link.sent()) {
    EXPECT_FALSE(std::holds_alternative<ReleaseProtectiveStop>(body)) << "a tap must not release";
  }
}

TEST_F(StateCardTest, AStopsNameIsNeverMarkup) {
  RobotStatus status = *station.models.status.status();
  status.word = StatusWord::Stopped;
  status.stop.latched = true;
  status.stop.source = "<img src=\"/dev/zero\">x. <b>Standstill is proven.</b>";
  emit station.link.status(std::make_shared<const RobotStatus>(status));
  station.settle();
  for (const QLabel* label : card.findChildren<QLabel*>())
    EXPECT_FALSE(label->text().contains("<img") || label->text().contains("<b>Standstill"))
        << label->text().toStdString();
}

TEST_F(StateCardTest, AGuardWithAnOldInputNeedsAttention) {
  station.startMission();
  FsmStatus fsm = *station.models.fsm.status();
  fsm.guards = {{"Heat source seen", true, "", 0.1},
                {"Arm at pose", false, "0.2 m", 0.02},
                {"Pump ready", true, "", 2.5}};
  emit station.link.fsmStatus(std::make_shared<const FsmStatus>(fsm));
  station.settle();
  ASSERT_EQ(card.ticks()->rows().size(), 3U);
  EXPECT_EQ(card.ticks()->rows()[0].mark, TickList::Mark::Met);
  EXPECT_EQ(card.ticks()->rows()[1].mark, TickList::Mark::Waiting);
  EXPECT_EQ(card.ticks()->rows()[2].mark, TickList::Mark::Attention);
  EXPECT_EQ(card.ticks()->rows()[2].level, AgeLevel::Red);
}

TEST_F(StateCardTest, AnExitIsOnlyTakenAfterTheHold) {
  station.startMission();
  station.pass(1.0);
  ASSERT_FALSE(card.exits().empty());
  QTest::mouseClick(card.exits().front(), Qt::LeftButton);
  EXPECT_EQ(jump.phase(), ForcedJump::Phase::Picked);
  EXPECT_EQ(station.models.fsm.current(), "EnterBuilding");
  const QString target = jump.target();
  hold(tile.panel()->jumpButton(), 1.1);
  const auto& visits = station.models.fsm.visits();  // the mission may have gone on from there
  EXPECT_TRUE(std::any_of(visits.begin(), visits.end(), [&](const Visit& v) {
    return v.state == target && v.cause == TransitionCause::Operator;
  })) << jump.message().toStdString();
}

TEST_F(StateCardTest, AForcedJumpGoesThroughArmPickAndHold) {
  station.startMission();
  station.pass(1.0);
  hold(tile.panel()->armButton(), 0.5);
  EXPECT_EQ(jump.phase(), ForcedJump::Phase::Idle) << "half a hold must not arm";
  hold(tile.panel()->armButton(), 1.1);
  ASSERT_EQ(jump.phase(), ForcedJump::Phase::Armed);
  const auto box = tile.graph()->nodeRect("SafeStop");
  ASSERT_TRUE(box.has_value());
  QTest::mouseClick(tile.graph(), Qt::LeftButton, {}, box->center().toPoint());
  ASSERT_EQ(jump.phase(), ForcedJump::Phase::Picked);
  hold(tile.panel()->jumpButton(), 1.1);
  EXPECT_EQ(station.models.fsm.current(), "SafeStop");
}

TEST_F(StateCardTest, TilesAreHatchedWhenTheirDataIsOld) {
  station.pass(0.5);
  EXPECT_FALSE(tile.hatched());
  station.link.setSilent(true);
  station.pass(3.5);
  EXPECT_TRUE(tile.hatched());
  EXPECT_TRUE(card.hatched());
  station.link.setSilent(false);
  station.pass(0.5);
  EXPECT_FALSE(tile.hatched());
}

}  // namespace
}  // namespace kiln::gui
