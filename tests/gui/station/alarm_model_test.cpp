#include "gui/models/alarm_model.h"

#include <gtest/gtest.h>

#include "tests/gui/views/scripted_link.h"

namespace kiln::gui {
namespace {

class AlarmModelTest : public testing::Test {
 protected:
  AlarmModelTest() { status.alarms = {warning, caution}; }
  /// The robot speaks.
  void tell() {
    link.time.advanceBy(fromSeconds(0.1));
    status.stamp = link.time.now();
    emit link.status(std::make_shared<const RobotStatus>(status));
  }
  void answer(CommandState state, const std::string& code = {}) {
    emit link.command({link.sent.size(), "acknowledge_alarm", state, code, "why not", "", 0.1});
  }
  [[nodiscard]] const AlarmModel::Entry* find(const std::string& id) const {
    for (const auto& entry : alarms.entries())
      if (entry.alarm.id == id) return &entry;
    return nullptr;
  }
  Alarm warning{"arm", AlarmLevel::Warning, "Arm stands", "look", Stamp{fromSeconds(90)}};
  Alarm caution{"lidar", AlarmLevel::Caution, "LiDAR silent", "cable", Stamp{fromSeconds(91)}};
  ScriptedLink link;
  RobotStatus status;
  CommandModel commands{link};
  AlarmModel alarms{link, commands};
};

TEST_F(AlarmModelTest, IsAcknowledgedWhenTheRobotSaysSo) {
  tell();
  alarms.acknowledge("arm");
  ASSERT_EQ(link.sent.size(), 1U);
  EXPECT_FALSE(find("arm")->alarm.acknowledged) << "asked is not answered";
  EXPECT_EQ(alarms.next()->alarm.id, "lidar") << "the next one can be acknowledged meanwhile";
  answer(CommandState::Done);
  EXPECT_FALSE(find("arm")->alarm.acknowledged);
  status.alarms[0].acknowledged = true;
  tell();
  EXPECT_TRUE(find("arm")->alarm.acknowledged);
}

TEST_F(AlarmModelTest, ARefusedOrUnansweredAcknowledgementStaysOpen) {
  tell();
  alarms.acknowledge("arm");
  answer(CommandState::Refused, "busy");
  EXPECT_EQ(alarms.next()->alarm.id, "arm");
  EXPECT_EQ(alarms.unacknowledgedCount(), 2);
  alarms.acknowledge("arm");
  EXPECT_EQ(alarms.unacknowledgedCount(), 1);
  answer(CommandState::Unknown);
  EXPECT_EQ(alarms.next()->alarm.id, "arm") << "no answer is no acknowledgement";
}

TEST_F(AlarmModelTest, AYesThatTheRobotDoesNotKeepIsTakenBack) {
  tell();
  alarms.acknowledge("arm");
  answer(CommandState::Done);
  tell();
  EXPECT_EQ(alarms.unacknowledgedCount(), 1);
  for (int i = 0; i < 12; ++i) tell();
  EXPECT_EQ(alarms.unacknowledgedCount(), 2);
}

TEST_F(AlarmModelTest, OneThatIsOverNeverHidesAnActiveOne) {
  status.alarms[0].active = false;  // the warning is over, the caution stands
  tell();
  EXPECT_EQ(alarms.top()->alarm.id, "lidar");
  status.alarms[1].acknowledged = true;
  tell();
  EXPECT_EQ(alarms.top()->alarm.id, "lidar") << "acknowledged, but it stands";
  EXPECT_EQ(alarms.next()->alarm.id, "arm") << "the key acknowledges what is over";
}

TEST_F(AlarmModelTest, WhatTheRobotTellsNoMoreIsGone) {
  tell();
  status.alarms.erase(status.alarms.begin());  // over, and acknowledged at another station
  tell();
  EXPECT_EQ(find("arm"), nullptr);
}

TEST_F(AlarmModelTest, TheStationsOwnNeedNoRobot) {
  alarms.setOwn("station.link_lost", AlarmLevel::Warning, true, "No link", "check radio");
  alarms.acknowledge("station.link_lost");
  EXPECT_TRUE(link.sent.empty());
  EXPECT_TRUE(find("station.link_lost")->alarm.acknowledged);
  alarms.setOwn("station.link_lost", AlarmLevel::Warning, false, {}, {});
  EXPECT_EQ(alarms.top(), nullptr);
}

}  // namespace
}  // namespace kiln::gui
