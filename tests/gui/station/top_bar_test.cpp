#include "gui/views/top_bar/top_bar.h"

#include <QTest>

#include <gtest/gtest.h>

#include "gui/views/top_bar/lease_chip.h"
#include "gui/views/top_bar/status_word.h"
#include "gui/views/top_bar/stop_button.h"
#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

class TopBarTest : public testing::Test {
 protected:
  TopBarTest() {
    bar.resize(1680, 48);
    bar.show();
    station.pass(2.0);
  }
  SteppedStation station;
  Theme theme;
  TopBar bar{{theme, station.link.clock()}, station.models};
};

TEST_F(TopBarTest, TheLeaseChipTellsWhoIsInControl) {
  EXPECT_EQ(bar.leaseChip()->text(), "Control is free");
  QTest::mouseClick(bar.leaseChip()->button(), Qt::LeftButton);
  station.settle();
  EXPECT_EQ(bar.leaseChip()->text(), "You in control");
  EXPECT_EQ(bar.leaseChip()->button()->text(), "Release");
  QTest::mouseClick(bar.leaseChip()->button(), Qt::LeftButton);
  station.settle();
  station.link.robot().ask("another", "Ada", AcquireLease{});
  station.pass(0.2);
  EXPECT_EQ(bar.leaseChip()->text(), "Ada in control");
  EXPECT_EQ(bar.leaseChip()->button()->text(), "Take over");
}

TEST_F(TopBarTest, StopWorksWithoutTheLeaseAtThePressAndShowsItsStages) {
  station.link.robot().ask("another", "Ada", AcquireLease{});
  station.pass(0.2);
  station.startMission();
  station.pass(4.0);
  ASSERT_GT(station.models.status.status()->twist.vx_mps, 0.2);
  EXPECT_EQ(bar.stopButton()->caption(), "software");
  QTest::mousePress(bar.stopButton(), Qt::LeftButton);  // no release needed
  station.settle();
  EXPECT_EQ(bar.stopButton()->caption(), "latched");
  EXPECT_EQ(bar.statusBlock()->word(), "STOPPED");
  station.pass(1.0);
  EXPECT_EQ(bar.stopButton()->caption(), "standstill ✓");
}

TEST_F(TopBarTest, ClearingAStopNeedsTheLeaseAndTheFullHold) {
  station.models.stop.press();
  station.settle();
  EXPECT_TRUE(bar.clearButton()->isVisible());
  EXPECT_FALSE(bar.clearButton()->isEnabled());
  station.takeLease();
  ASSERT_TRUE(bar.clearButton()->isEnabled());
  QTest::mousePress(bar.clearButton(), Qt::LeftButton);
  station.link.advance(0.8);
  bar.clearButton()->tick();
  EXPECT_TRUE(station.models.stop.latched());
  station.link.advance(0.3);
  bar.clearButton()->tick();
  station.settle();
  EXPECT_FALSE(station.models.stop.latched());
  EXPECT_FALSE(bar.clearButton()->isVisible());
}

TEST_F(TopBarTest, AStopLaneWithoutAPeerSaysSo) {
  station.link.setSilent(true);
  station.pass(4.0);
  EXPECT_EQ(bar.stopButton()->caption(), "NO LINK");
  EXPECT_EQ(bar.statusBlock()->word(), "NO LINK");
  EXPECT_EQ(bar.leaseChip()->text(), "Lease unknown");
}

TEST_F(TopBarTest, ALostLinkLeavesTheWordOfWhatTheRobotDoesAlone) {
  station.startMission();
  station.pass(1.0);
  station.link.setSilent(true);
  for (int i = 0; i < 4; ++i) {
    station.pass(1.7);
    EXPECT_TRUE(bar.statusBlock()->reason().contains("GOES ON by itself"))
        << bar.statusBlock()->reason().toStdString();
  }
}

TEST_F(TopBarTest, TheSentenceBesideTheWordIsNeverCutOff) {
  const auto look = [&] {
    for (const int width : {936, 1000, 1272, 1358, 1672, 1912}) {
      bar.resize(width, 48);
      QCoreApplication::processEvents();  // the layout
      (void)bar.grab();
      const FittedText text = bar.statusBlock()->fittedReason();
      EXPECT_TRUE(text.whole) << width << ": " << text.lines.join('|').toStdString();
      EXPECT_LE(text.height(), 48) << width;
      EXPECT_EQ(bar.statusBlock()->toolTip(), bar.statusBlock()->reason());
    }
  };
  for (Check& check : station.link.robot().checks) {
    const Check fine = check;
    check.ok = false;
    check.detail = "no scan for 2.1 s";
    check.action = "Check its cable and its power, then restart the daemon on the robot.";
    station.pass(0.3);
    look();
    check = fine;
  }
  station.startMission();
  for (int i = 0; i < 20; ++i) {
    station.pass(1.5);
    look();
  }
  station.link.robot().stop("Benjamin the second");
  station.pass(0.3);
  look();
  station.link.setSilent(true);
  station.pass(8.0);
  look();
}

TEST_F(TopBarTest, WithoutALinkStopIsStillPressedKeptAndSaysWhatToDo) {
  EXPECT_TRUE(bar.stopNote()->isHidden());
  station.link.setSilent(true);
  station.pass(4.0);
  ASSERT_TRUE(bar.stopNote()->isVisible());
  EXPECT_TRUE(bar.stopNote()->text().contains("red button"))
      << bar.stopNote()->text().toStdString();
  QTest::mousePress(bar.stopButton(), Qt::LeftButton);
  station.settle();
  EXPECT_EQ(bar.stopButton()->caption(), "kept, no link");
  EXPECT_TRUE(bar.stopNote()->text().contains("NOT got it"))
      << bar.stopNote()->text().toStdString();
  station.link.setSilent(false);
  station.pass(1.0);
  EXPECT_TRUE(station.models.stop.latched()) << "the kept press went out with the link";
  EXPECT_TRUE(bar.stopNote()->isHidden());
}

TEST_F(TopBarTest, TheStopKeyIsRedAndTheNoteWholeAtEveryWidth) {
  station.link.setSilent(true);
  station.pass(4.0);
  const auto reds = [&] {
    const QImage image = bar.stopButton()->grab().toImage();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const QColor c = image.pixelColor(x, y);
        if (c.red() > 120 && c.green() < 60 && c.blue() < 70) ++count;
      }
    return count;
  };
  for (const int width : {1272, 1358, 1672, 1912}) {
    bar.resize(width, 48);
    station.pass(0.2);
    EXPECT_GT(reds(), 500) << width;
    EXPECT_GE(bar.stopNote()->width(), bar.stopNote()->sizeHint().width()) << width;
    EXPECT_LE(bar.stopButton()->geometry().right(), width) << width;
    EXPECT_TRUE(bar.leaseChip()->isVisible() && bar.statusBlock()->width() >= 330)
        << width << ": " << bar.statusBlock()->width();
  }
}

}  // namespace
}  // namespace kiln::gui
