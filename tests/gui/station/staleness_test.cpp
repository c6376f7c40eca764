#include <gtest/gtest.h>

#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

TEST(Staleness, StatusIsAmberAtOneAndAHalfAndRedAtThreeSeconds) {
  SteppedStation station;
  station.pass(2.0);
  EXPECT_EQ(station.models.status.ageLevel(), AgeLevel::Fresh);
  station.link.setSilent(true);
  station.pass(1.4);
  EXPECT_EQ(station.models.status.ageLevel(), AgeLevel::Fresh);
  station.pass(0.2);
  EXPECT_EQ(station.models.status.ageLevel(), AgeLevel::Amber);
  EXPECT_NE(station.models.status.word(), StatusWord::NoLink);
  station.pass(1.5);
  EXPECT_EQ(station.models.status.ageLevel(), AgeLevel::Red);
  EXPECT_EQ(station.models.status.word(), StatusWord::NoLink) << "old words must not stand";
  EXPECT_EQ(station.models.lease.holder(), LeaseHolder::Unknown);
  EXPECT_FALSE(station.models.mayCommand());
}

TEST(Staleness, RepeatingAnOldPictureDoesNotMakeItYoung) {
  SteppedStation station;
  auto frozen = std::make_shared<RgbImage>();
  frozen->frame = "operator_camera";
  frozen->data.resize(3);
  frozen->stamp = station.link.clock().now();
  for (int i = 0; i < 30; ++i) {
    station.pass(0.1);
    emit station.link.image(frozen);
  }
  EXPECT_NEAR(station.models.camera.ageS(), 3.0, 0.01);
  EXPECT_EQ(station.models.camera.ageLevel(), AgeLevel::Red);
}

TEST(Staleness, ALostLinkRaisesAnAlarmThatOutlivesItUntilAcknowledged) {
  SteppedStation station;
  station.pass(2.0);
  station.link.setSilent(true);
  station.pass(2.0);
  ASSERT_NE(station.models.alarms.top(), nullptr);
  EXPECT_EQ(station.models.alarms.top()->alarm.id, "station.link_lost");
  EXPECT_EQ(station.models.alarms.top()->alarm.level, AlarmLevel::Warning);
  station.link.setSilent(false);
  station.pass(1.0);
  ASSERT_NE(station.models.alarms.top(), nullptr);
  EXPECT_FALSE(station.models.alarms.top()->alarm.active);
  station.models.alarms.acknowledge("station.link_lost");
  EXPECT_EQ(station.models.alarms.top(), nullptr);
}

TEST(Staleness, ALostLinkSaysWhatTheRobotDoesByItself) {
  for (const bool by_hand : {false, true}) {
    SteppedStation station;
    station.takeLease();
    station.startMission();
    if (by_hand) station.models.commands.send(SetMode{Mode::Teleop}, "teleop");
    station.pass(1.0);
    station.link.setSilent(true);
    station.pass(1.7);
    const AlarmModel::Entry* top = station.models.alarms.top();
    ASSERT_NE(top, nullptr);
    EXPECT_NE(top->alarm.action.find(by_hand ? "pumps off" : "GOES ON by itself"),
              std::string::npos)
        << top->alarm.action;
    EXPECT_FALSE(station.models.mayCommand());
    EXPECT_EQ(station.models.lease.holder(), LeaseHolder::Unknown);
    EXPECT_EQ(station.models.localization.summary(), "unknown");
  }
}

TEST(Staleness, TheClockOfAStateNeverRunsBack) {
  SteppedStation station;
  station.startMission();
  station.pass(2.0);
  station.link.setSilent(true);
  double shown_s = 0.0;
  for (int i = 0; i < 40; ++i) {
    station.pass(0.1);
    EXPECT_GE(station.models.fsm.timeInStateS(), shown_s);
    shown_s = station.models.fsm.timeInStateS();
  }
}

TEST(Staleness, ADeafRobotIsTold) {
  SteppedStation station;
  station.pass(2.0);
  station.link.setDeaf(true);
  station.pass(2.0);
  ASSERT_NE(station.models.alarms.top(), nullptr);
  EXPECT_EQ(station.models.alarms.top()->alarm.id, "station.not_heard");
}

TEST(Staleness, TheStationsOwnAlarmsAreInTheEventLog) {
  SteppedStation station(true);
  station.pass(2.0);
  const auto logged = [&](const std::string& words) {
    int count = 0;
    for (const LogLine& line : station.models.log.lines())
      count += line.logger == "station" && line.text.find(words) != std::string::npos ? 1 : 0;
    return count;
  };
  station.link.setSilent(true);
  for (int i = 0; i < 30; ++i) station.pass(0.2);
  EXPECT_EQ(logged("alarm: No link to the robot"), 1) << "once, not each time that it is judged";
  EXPECT_EQ(logged("alarm over"), 0);
  station.link.setSilent(false);
  station.pass(1.0);
  EXPECT_EQ(logged("alarm over: No link to the robot"), 1);
  for (int i = 0; i < 20; ++i) station.pass(0.2);
  EXPECT_EQ(logged("alarm"), 2);
}

TEST(Staleness, AFrozenCameraIsNotOverBecauseTheLinkIsLost) {
  SteppedStation station;
  auto frozen = std::make_shared<RgbImage>();
  frozen->frame = "operator_camera";
  frozen->data.resize(3);
  frozen->stamp = station.link.clock().now();
  emit station.link.image(frozen);
  station.pass(4.0);
  const auto standing = [&] {
    for (const auto& entry : station.models.alarms.entries())
      if (entry.alarm.id == "station.camera_stale") return entry.alarm.active;
    return false;
  };
  EXPECT_TRUE(standing());
  station.link.setSilent(true);
  station.pass(4.0);
  EXPECT_TRUE(standing());
}

}  // namespace
}  // namespace kiln::gui
