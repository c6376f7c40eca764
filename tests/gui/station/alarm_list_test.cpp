#include "gui/views/alarm_strip/alarm_list.h"

#include <QTest>

#include <gtest/gtest.h>

#include "gui/views/alarm_strip/alarm_strip.h"
#include "robot/app/alarm_book.h"
#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

class AlarmListTest : public testing::Test {
 protected:
  AlarmListTest() {
    list.resize(700, 300);
    QObject::connect(&strip, &AlarmStrip::listRequested, &list, &AlarmList::toggle);
    station.takeLease();
    raise("old", AlarmLevel::Warning, true);
    raise("old", AlarmLevel::Warning, false);
    raise("late", AlarmLevel::Caution, true);
    QTest::mouseClick(&strip, Qt::LeftButton, {}, {60, 12});
  }
  void raise(const std::string& id, AlarmLevel level, bool active) {
    station.link.robot().alarms().set(id, active, level, id + " text", "do this about " + id,
                                      station.link.robot().now());
    station.pass(0.2);
  }
  [[nodiscard]] QStringList texts() const {
    QStringList out;
    for (const AlarmRow* row : list.rows()) out << row->words()[1];
    return out;
  }
  SteppedStation station;
  Theme theme;
  AlarmStrip strip{{theme, station.link.clock()}, station.models};
  AlarmList list{{theme, station.link.clock()}, station.models};
};

TEST_F(AlarmListTest, AClickOnTheStripOpensAllOfThemActiveFirst) {
  ASSERT_TRUE(list.isVisible());
  EXPECT_EQ(texts(), QStringList({"late text", "old text"}));
  EXPECT_TRUE(strip.text().startsWith("late text")) << strip.text().toStdString();
  station.pass(12.0);
  EXPECT_EQ(list.rows()[0]->words(),
            QStringList({"Caution", "late text", "do this about late", "for 12 s"}));
  EXPECT_EQ(list.rows()[1]->words()[3], "over");
  QTest::mouseClick(&strip, Qt::LeftButton, {}, {60, 12});
  EXPECT_FALSE(list.isVisible());
}

TEST_F(AlarmListTest, EachHasItsKey) {
  QTest::mouseClick(list.rows()[1]->acknowledgeButton(), Qt::LeftButton);
  station.pass(0.3);
  EXPECT_EQ(texts(), QStringList({"late text"})) << "over and acknowledged: gone";
  QTest::mouseClick(list.rows()[0]->acknowledgeButton(), Qt::LeftButton);
  station.pass(0.3);
  ASSERT_EQ(list.rows().size(), 1U);
  EXPECT_TRUE(list.rows()[0]->words()[3].endsWith("acknowledged"));
  EXPECT_FALSE(list.rows()[0]->acknowledgeButton()->isVisible());
  raise("late", AlarmLevel::Caution, false);
  EXPECT_TRUE(list.rows().empty());
}

TEST_F(AlarmListTest, NoRowMovesUnderThePointer) {
  list.setAttribute(Qt::WA_UnderMouse, true);
  raise("worse", AlarmLevel::Warning, true);
  EXPECT_EQ(texts(), QStringList({"late text", "old text", "worse text"}));
  list.setAttribute(Qt::WA_UnderMouse, false);
  station.pass(0.2);
  EXPECT_EQ(texts(), QStringList({"worse text", "late text", "old text"}));
  QCoreApplication::processEvents();  // the layout
  for (std::size_t i = 1; i < list.rows().size(); ++i)
    EXPECT_GT(list.rows()[i]->y(), list.rows()[i - 1]->y());
}

TEST_F(AlarmListTest, ALongTextIsWholeAndTheRowAsHighAsItNeeds) {
  const int before = list.heightFor(500, 1000);
  station.link.robot().alarms().set(
      "wordy", true, AlarmLevel::Warning,
      "STOP by motion watch: the wheels turn at 0.41 m/s although 0.20 m/s are commanded since 0.4 "
      "s",
      "look at the wheels and at what the robot stands against, then clear the stop",
      station.link.robot().now());
  station.pass(0.2);
  const AlarmRow* row = list.rows()[0];
  EXPECT_GT(row->heightForWidth(320), row->heightForWidth(700));
  EXPECT_EQ(list.heightFor(500, 1000), before + row->heightForWidth(498));
  EXPECT_EQ(list.heightFor(500, 60), 60);
}

}  // namespace
}  // namespace kiln::gui
