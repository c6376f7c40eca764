#include "gui/models/fsm_model.h"

#include <gtest/gtest.h>

#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

TEST(FsmModel, KeepsVisitsTimesAndEdgesOfTheWholeMission) {
  SteppedStation station;
  station.startMission();
  const FsmModel& fsm = station.models.fsm;
  for (int i = 0; i < 60 && !fsm.status()->terminal; ++i) station.pass(10.0);
  EXPECT_EQ(fsm.current(), "Finished");
  EXPECT_EQ(fsm.record("DriveToLocation").visits, 2);
  EXPECT_EQ(fsm.record("NextLocation").visits, 3);
  EXPECT_EQ(fsm.timesTaken("NextLocation", "DriveToLocation"), 2);
  EXPECT_EQ(fsm.timesTaken("AimHose", "LostTarget"), 0);
  EXPECT_GT(fsm.record("SpraySteady").last_s, 14.0);
  EXPECT_EQ(fsm.recency("Finished"), 0);
  EXPECT_EQ(fsm.recency("ParkArm"), 1);
  EXPECT_EQ(fsm.recency("NextLocation"), 2);
  EXPECT_EQ(fsm.recency("EnterBuilding"), -1);
}

TEST(FsmModel, TheClockOfAStateStandsWhileTheLinkIsSilent) {
  SteppedStation station;
  station.startMission();
  station.pass(4.0);
  const double before = station.models.fsm.timeInStateS();
  station.link.setSilent(true);
  station.pass(60.0);
  EXPECT_LT(station.models.fsm.timeInStateS(), before + 2.0);
}

TEST(FsmModel, TheClockOfAStateStandsWhileTheMissionIsPaused) {
  SteppedStation station;
  station.takeLease();
  station.startMission();
  station.pass(4.0);
  station.models.commands.send(Pause{}, "pause");
  station.pass(1.0);
  const double paused = station.models.fsm.timeInStateS();
  station.pass(30.0);
  EXPECT_NEAR(station.models.fsm.timeInStateS(), paused, 0.3);
  station.models.commands.send(Resume{}, "resume");
  station.pass(2.0);
  EXPECT_GT(station.models.fsm.timeInStateS(), paused + 1.0);
  EXPECT_LT(station.models.fsm.timeInStateS(), paused + 4.0);
}

TEST(FsmModel, AStationThatJoinsLateCountsTheSame) {
  SteppedStation station;
  station.takeLease();
  station.startMission();
  station.pass(4.0);
  station.models.commands.send(Pause{}, "pause");
  station.pass(60.0);
  StationModels late(station.link);
  const auto both = [&] {
    return std::pair(station.models.fsm.timeInStateS(), late.fsm.timeInStateS());
  };
  station.pass(0.2);
  EXPECT_NEAR(both().second, both().first, 0.02) << "joined while it was held";
  EXPECT_LT(both().second, 6.0);
  station.models.commands.send(Resume{}, "resume");
  station.pass(3.0);
  EXPECT_NEAR(both().second, both().first, 0.02) << "and gone on";
  EXPECT_NEAR(both().second, 7.5, 1.0);
  // Joined after the pause is over, and from a robot that does not tell: it cannot know better.
  StationModels later(station.link);
  station.pass(0.2);
  EXPECT_NEAR(later.fsm.timeInStateS(), both().first, 0.02);
  FsmStatus untold = station.link.robot().fsmStatus();
  untold.paused_in_state.reset();
  emit station.link.fsmStatus(std::make_shared<const FsmStatus>(untold));
  EXPECT_GT(later.fsm.timeInStateS(), 60.0);
}

TEST(FsmModel, MarksForcedTransitions) {
  SteppedStation station;
  station.takeLease();
  station.startMission();
  station.pass(1.0);
  const auto step = station.models.fsm.status()->step;
  station.models.commands.send(ChangeState{"EnterBuilding", step, "SafeStop"}, "jump");
  station.settle();
  EXPECT_EQ(station.models.fsm.visits().back().cause, TransitionCause::Operator);
  EXPECT_EQ(station.models.fsm.visits().back().note, "by Ann");
}

}  // namespace
}  // namespace kiln::gui
