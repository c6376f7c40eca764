#include "gui/widgets/hold_button.h"

#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>
#include <QVBoxLayout>

#include <gtest/gtest.h>

namespace kiln::gui {
namespace {

class HoldButtonTest : public testing::Test {
 protected:
  HoldButtonTest() {
    auto* column = new QVBoxLayout(&window);
    column->addWidget(button);
    column->addWidget(other);
    window.show();
    QApplication::setActiveWindow(&window);
    button->setFocus();
  }
  void holdFor(double seconds) {
    clock.advanceBy(fromSeconds(seconds));
    button->tick();
  }
  ManualClock clock;
  Theme theme;
  QWidget window;
  HoldButton* button = new HoldButton({theme, clock}, "Clear stop", 1.0);
  QLineEdit* other = new QLineEdit;
  QSignalSpy completed{button, &HoldButton::completed};
  QSignalSpy engaged{button, &HoldButton::engaged};
  QSignalSpy disengaged{button, &HoldButton::disengaged};
};

TEST_F(HoldButtonTest, ActsOnceAfterTheFullHold) {
  QTest::mousePress(button, Qt::LeftButton);
  holdFor(0.99);
  EXPECT_EQ(completed.count(), 0);
  holdFor(0.02);
  EXPECT_EQ(completed.count(), 1);
  holdFor(5.0);
  QTest::mouseRelease(button, Qt::LeftButton);
  EXPECT_EQ(completed.count(), 1);
}

TEST_F(HoldButtonTest, AnEarlyReleaseDoesNothingAndTheNextHoldStartsAnew) {
  QTest::mousePress(button, Qt::LeftButton);
  holdFor(0.9);
  QTest::mouseRelease(button, Qt::LeftButton);
  QTest::mousePress(button, Qt::LeftButton);
  holdFor(0.9);
  QTest::mouseRelease(button, Qt::LeftButton);
  EXPECT_EQ(completed.count(), 0);
}

TEST_F(HoldButtonTest, FocusLossReleases) {
  button->setHold(0.0);
  QTest::mousePress(button, Qt::LeftButton);
  ASSERT_EQ(engaged.count(), 1);
  other->setFocus();
  EXPECT_EQ(disengaged.count(), 1);
  EXPECT_FALSE(button->isEngaged());
}

TEST_F(HoldButtonTest, HidingOrDisablingReleases) {
  button->setHold(0.0);
  QTest::mousePress(button, Qt::LeftButton);
  button->setEnabled(false);
  EXPECT_EQ(disengaged.count(), 1);
  button->setEnabled(true);
  QTest::mousePress(button, Qt::LeftButton);
  button->hide();
  EXPECT_EQ(disengaged.count(), 2);
}

TEST_F(HoldButtonTest, WindowDeactivationReleases) {
  button->setHold(0.0);
  QTest::mousePress(button, Qt::LeftButton);
  QEvent gone(QEvent::WindowDeactivate);
  QApplication::sendEvent(button, &gone);
  EXPECT_EQ(disengaged.count(), 1);
}

TEST_F(HoldButtonTest, SlidingOffReleases) {
  QTest::mousePress(button, Qt::LeftButton);
  holdFor(0.5);
  QMouseEvent away(QEvent::MouseMove, QPointF(-50, -50), Qt::LeftButton, Qt::LeftButton,
                   Qt::NoModifier);
  QApplication::sendEvent(button, &away);
  holdFor(1.0);
  EXPECT_EQ(completed.count(), 0);
  EXPECT_EQ(disengaged.count(), 1);
}

TEST_F(HoldButtonTest, SpaceNeverPressesIt) {
  QTest::keyPress(button, Qt::Key_Space);
  holdFor(2.0);
  EXPECT_EQ(engaged.count(), 0);
  EXPECT_EQ(completed.count(), 0);
}

TEST_F(HoldButtonTest, TheKeyboardCanHoldItWithReturn) {
  QTest::keyPress(button, Qt::Key_Return);
  holdFor(1.1);
  QTest::keyRelease(button, Qt::Key_Return);
  EXPECT_EQ(completed.count(), 1);
  EXPECT_EQ(disengaged.count(), 1);
}

TEST_F(HoldButtonTest, TheReleaseIsTakenWhereverItHappens) {
  button->setHold(0.0);
  QTest::mousePress(button, Qt::LeftButton);
  button->move(button->pos() + QPoint(0, 300));  // a layout that moves the row away
  EXPECT_EQ(disengaged.count(), 1) << "moved from under the hand";
  QTest::mousePress(button, Qt::LeftButton);
  QTest::mouseRelease(other, Qt::LeftButton);
  EXPECT_EQ(disengaged.count(), 2) << "let go over another widget";
  QTest::mousePress(button, Qt::LeftButton);
  QMouseEvent bare(QEvent::MouseMove, QPointF(3, 3), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(other, &bare);
  EXPECT_EQ(disengaged.count(), 3) << "a mouse without its button down has let go";
  QTest::mousePress(button, Qt::LeftButton);
  QEvent dialog(QEvent::WindowBlocked);
  QApplication::sendEvent(&window, &dialog);
  EXPECT_EQ(disengaged.count(), 4);
}

TEST_F(HoldButtonTest, ComingBackWithTheButtonDownIsNoPress) {
  button->setHold(0.0);
  QTest::mousePress(button, Qt::LeftButton);
  const auto move = [&](const QPointF& to) {
    QMouseEvent event(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(button, &event);
  };
  move({-50, -50});
  EXPECT_EQ(disengaged.count(), 1);
  move({5, 5});
  EXPECT_EQ(engaged.count(), 1);
  QTest::mouseRelease(button, Qt::LeftButton);
  QTest::mousePress(button, Qt::LeftButton);
  button->cancel();  // the robot has ended it
  move({6, 6});
  EXPECT_EQ(engaged.count(), 2) << "only a new press";
}

TEST_F(HoldButtonTest, AButtonThatDiesHasLetGo) {
  button->setHold(0.0);
  QTest::mousePress(button, Qt::LeftButton);
  delete button;
  EXPECT_EQ(disengaged.count(), 1);
}

}  // namespace
}  // namespace kiln::gui
