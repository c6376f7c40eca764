#include <random>

#include <gtest/gtest.h>

#include "gui/views/timeline/command_lane.h"
#include "gui/views/timeline/timeline_view.h"
#include "robot/app/alarm_book.h"
#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

constexpr double kLeft = 100.0, kRight = 700.0;

TEST(CommandLane, EveryNameStandsBesideItsOwnMark) {
  std::mt19937 random(4);
  int before = 0, behind = 0;
  for (int round = 0; round < 500; ++round) {
    std::vector<CommandMark> marks;
    for (int i = 0; i < 12; ++i)
      marks.push_back({kLeft + static_cast<double>(random() % 600), 30.0 + random() % 90});
    std::sort(marks.begin(), marks.end(),
              [](const CommandMark& a, const CommandMark& b) { return a.x < b.x; });
    for (const auto& [i, left] : placeCommandNames(marks, kLeft, kRight)) {
      const double right = left + marks[i].name_px;
      EXPECT_TRUE(left >= kLeft && right <= kRight);
      (left > marks[i].x ? behind : before) += 1;
      const double own = left > marks[i].x ? left - marks[i].x : marks[i].x - right;
      EXPECT_GT(own, 0.0);
      for (std::size_t k = 0; k < marks.size(); ++k) {
        if (k == i) continue;
        EXPECT_FALSE(marks[k].x > left && marks[k].x < right) << "over another mark";
        // What precedes a name is taken for its mark.
        if (marks[k].x <= left && left < marks[i].x) EXPECT_GT(left - marks[k].x, 2.0 * own);
      }
    }
  }
  EXPECT_GT(before, 100);
  EXPECT_GT(behind, 100);
}

TEST(CommandLane, ANameWithoutRoomIsLeftOut) {
  const auto names = placeCommandNames({{690.0, 80.0}, {694.0, 80.0}}, kLeft, kRight);
  ASSERT_EQ(names.size(), 1U) << "before both marks it would seem to be that of the first";
  EXPECT_EQ(names[0].mark, 0U);
  EXPECT_TRUE(placeCommandNames({{400.0, 400.0}}, kLeft, kRight).empty());
}

TEST(TimelineState, EndsWhereItWasHeardLast) {
  SteppedStation station;
  station.startMission();
  station.pass(5.0);
  const auto known = [&] {
    return toSeconds(station.link.clock().now() - station.models.fsm.knownUntil());
  };
  EXPECT_LT(known(), 0.01) << "as long as the robot speaks";
  station.link.setSilent(true);
  station.pass(8.0);
  EXPECT_NEAR(known(), 7.5, 0.15);
  const double in_state_s = station.models.fsm.timeInStateS();
  station.pass(5.0);
  EXPECT_EQ(station.models.fsm.timeInStateS(), in_state_s);
}

class TimelineTest : public testing::Test {
 protected:
  TimelineTest() {
    view.resize(1200, 190);
    view.show();
    station.takeLease();
  }
  [[nodiscard]] QString valueAt(double back_s, const QString& lane) const {
    const Stamp then = station.link.clock().now() - fromSeconds(back_s);
    for (const QString& line : view.valuesAt(view.axis().xOf(then)))
      if (line.startsWith(lane + ":")) return line.mid(lane.size() + 2);
    return {};
  }
  void pass(double seconds) {
    for (double left = seconds; left > 1e-9; left -= 0.2) station.pass(0.2);
  }
  SteppedStation station{true};
  Theme theme;
  TimelineView view{{theme, station.link.clock()}, station.models};
};

TEST_F(TimelineTest, TheCrossHairTellsWhatWasThen) {
  station.startMission();
  pass(6.0);
  station.link.robot().alarms().set("a", true, AlarmLevel::Warning, "arm stands", "look",
                                    station.link.robot().now());
  station.models.stop.press();
  pass(4.0);
  station.takeLease();  // the STOP has revoked it
  station.models.stop.clear();
  pass(4.0);
  EXPECT_TRUE(valueAt(6.0, "STOP").startsWith("STOP by Ann")) << valueAt(6.0, "STOP").toStdString();
  EXPECT_TRUE(valueAt(11.0, "STOP").isEmpty());
  EXPECT_TRUE(valueAt(11.0, "Mode").startsWith("AUTO"));
  EXPECT_TRUE(valueAt(6.0, "Mode").startsWith("STOPPED"));
  EXPECT_TRUE(valueAt(1.0, "Alarms").startsWith("arm stands"));
  EXPECT_FALSE(valueAt(8.0, "State").isEmpty());
  EXPECT_TRUE(valueAt(1.0, "Arm force N").endsWith("N"));
  EXPECT_TRUE(valueAt(1.0, "Link ms").endsWith("ms"));
  const TrackedCommand& clear = station.models.commands.commands().back();
  EXPECT_TRUE(valueAt(toSeconds(station.link.clock().now() - clear.sent), "Commands")
                  .startsWith("clear the stop"));
}

TEST_F(TimelineTest, PumpsAndMacrosHaveTheirLanes) {
  station.models.commands.send(SetMode{Mode::Teleop}, "teleop");
  pass(1.0);
  const std::uint64_t press = station.link.press();
  for (int i = 0; i < 15; ++i) {
    station.link.startSetpoint(HoldActuator{kPumps, 1.0}, press);
    station.pass(0.1);
  }
  station.link.releaseSetpoints();
  pass(2.0);
  EXPECT_TRUE(valueAt(2.6, "Actuators").startsWith("Pump left, Pump right"))
      << view.valuesAt(view.axis().xOf(station.link.clock().now() - fromSeconds(2.6)))
             .join('|')
             .toStdString();
  EXPECT_TRUE(valueAt(0.5, "Actuators").isEmpty());
}

TEST_F(TimelineTest, AllLanesCanBeReadAndTheLeastImportantGoesFirst) {
  const QStringList most = view.lanes();
  for (const char* lane :
       {"State", "Mode", "STOP", "Alarms", "Commands", "Macros", "Actuators", "Arm force N"})
    EXPECT_TRUE(most.contains(lane)) << lane;
  for (const int height : {118, 140, 170, 220, 400}) {
    view.resize(1200, height);
    const QStringList lanes = view.lanes();
    EXPECT_GE((height - 18.0) / lanes.size(), 15.0) << height;
    for (const char* lane : {"State", "STOP", "Alarms", "Commands"})
      EXPECT_TRUE(lanes.contains(lane)) << lane << " at " << height;
  }
}

}  // namespace
}  // namespace kiln::gui
