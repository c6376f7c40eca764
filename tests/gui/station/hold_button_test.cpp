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

}  // namespace
}  // namespace kiln::gui
