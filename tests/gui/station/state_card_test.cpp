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

TEST_F(StateCardTest, WhatAnExitDoesIsToBeReadWhole) {
  station.startMission();
  FsmStatus fsm = *station.models.fsm.status();
  std::size_t most = 0;
  for (const QSize size : {QSize(366, 206), QSize(403, 244), QSize(430, 420)}) {
    card.resize(size);
    for (const FsmStateInfo& state : station.models.fsm.info()->states) {
      fsm.state = state.name;
      emit station.link.fsmStatus(std::make_shared<const FsmStatus>(fsm));
      station.models.flush();
      QCoreApplication::processEvents();
      most = std::max(most, card.exits().size());
      std::vector<QRect> before;
      for (const ActButton* exit : card.exits()) before.push_back(exit->geometry());
      for (ActButton* exit : card.exits()) {
        QEvent enter(QEvent::Enter), leave(QEvent::Leave);
        QCoreApplication::sendEvent(exit, &enter);
        EXPECT_TRUE(card.exitList()->whole())
            << state.name << " -> " << exit->text().toStdString() << " at " << size.width() << "x"
            << size.height() << ": " << card.exitList()->told().toStdString();
        QCoreApplication::sendEvent(exit, &leave);
        const QString told = card.exitList()->told() + exit->subtext();
        EXPECT_FALSE(told.isEmpty());
      }
      for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_EQ(card.exits()[i]->geometry(), before[i]) << "pointing at it moved it";
    }
  }
  EXPECT_EQ(most, ExitList::kMost) << "nothing was crowded";
}

TEST_F(StateCardTest, TheStripTellsOfTheExitUnderThePointer) {
  station.startMission();
  const auto& info = *station.models.fsm.info();
  card.resize(366, 240);
  for (int i = 0; i < 600 && card.exits().size() < 3; ++i) station.pass(0.3);
  ASSERT_GE(card.exits().size(), 3U);
  const QString calm = card.exitList()->told();
  ActButton* exit = card.exits()[1];
  QEvent enter(QEvent::Enter), leave(QEvent::Leave);
  QCoreApplication::sendEvent(exit, &enter);
  const QString told = card.exitList()->told();
  const bool known = std::any_of(info.edges.begin(), info.edges.end(), [&](const FsmEdgeInfo& e) {
    return !e.consequence.empty() && told.endsWith(QString::fromStdString(e.consequence));
  });
  EXPECT_TRUE(known) << told.toStdString();
  QCoreApplication::sendEvent(exit, &leave);
  EXPECT_EQ(card.exitList()->told(), calm);
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
