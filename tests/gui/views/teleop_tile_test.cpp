#include "gui/views/teleop/teleop_tile.h"

#include <QLineEdit>

#include "gui/views/macros/macros_tile.h"
#include "tests/gui/views/station_fixture.h"

namespace kiln::gui {
namespace {

class TeleopTileTest : public StationTest {
 protected:
  TeleopTileTest() {
    auto* layout = new QVBoxLayout(&window);
    layout->addWidget(&tile);
    layout->addWidget(&macros);
    layout->addWidget(&elsewhere);
    window.show();
    window.activateWindow();
    QCoreApplication::processEvents();
    tile.panel().setFocus();
    QCoreApplication::processEvents();
  }
  ~TeleopTileTest() override {
    for (QWidget* child : {static_cast<QWidget*>(&tile), static_cast<QWidget*>(&macros),
                           static_cast<QWidget*>(&elsewhere)})
      child->setParent(nullptr);
  }

  void holdW() {
    key(tile.panel(), QEvent::KeyPress, Qt::Key_W);
    ASSERT_TRUE(hold.holding(HoldKind::Base));
    ASSERT_EQ(link.releases, 0);
  }
  void expectReleased() {
    EXPECT_FALSE(hold.holding());
    EXPECT_GE(link.releases, 1);
    const std::size_t sent = link.setpoints.size();
    hold.renew();
    EXPECT_EQ(link.setpoints.size(), sent);  // nothing runs on
    EXPECT_EQ(tile.panel().drivePad().value(), QPointF());
  }

  TeleopTile tile{ui, hold};
  MacrosTile macros{ui, hold};
  QLineEdit elsewhere;
  QWidget window;
};

TEST_F(TeleopTileTest, AKeyDrivesUntilItIsReleased) {
  holdW();
  EXPECT_DOUBLE_EQ(lastSetpoint<JogBase>()->twist.vx_mps, 1.0);
  key(tile.panel(), QEvent::KeyRelease, Qt::Key_W, Qt::NoModifier, true);  // auto-repeat
  EXPECT_TRUE(hold.holding());
  key(tile.panel(), QEvent::KeyRelease, Qt::Key_W);
  expectReleased();
}

TEST_F(TeleopTileTest, FocusThatGoesElsewhereReleases) {
  holdW();
  elsewhere.setFocus();
  expectReleased();
}

TEST_F(TeleopTileTest, AWindowThatIsDeactivatedReleases) {
  holdW();
  QEvent event(QEvent::WindowDeactivate);
  QCoreApplication::sendEvent(&window, &event);
  expectReleased();
}

TEST_F(TeleopTileTest, ADialogReleases) {
  holdW();
  QEvent event(QEvent::WindowBlocked);  // what Qt sends to the window under a modal dialog
  QCoreApplication::sendEvent(&window, &event);
  expectReleased();
}

TEST_F(TeleopTileTest, AHiddenPanelReleases) {
  holdW();
  tile.hide();
  expectReleased();
}

TEST_F(TeleopTileTest, AStickHeldByTheMouseIsLetGoWithTheFocus) {
  JogPad& pad = tile.panel().drivePad();
  mouse(pad, QEvent::MouseButtonPress, {pad.width() / 2.0, 0.0});
  ASSERT_TRUE(hold.holding(HoldKind::Base));
  elsewhere.setFocus();
  expectReleased();
  mouse(pad, QEvent::MouseMove,
        {pad.width() / 2.0, 0.0});  // the button is still down: nothing resumes
  EXPECT_FALSE(hold.holding());
}

TEST_F(TeleopTileTest, LockedSticksSayWhyAndSendNothing) {
  status.mode = Mode::Supervised;
  feed();
  EXPECT_TRUE(tile.lockReason().contains("Teleop"));
  EXPECT_FALSE(tile.panel().drivePad().isEnabled());
  key(tile.panel(), QEvent::KeyPress, Qt::Key_W);
  EXPECT_TRUE(link.setpoints.empty());
}

TEST_F(TeleopTileTest, ThePumpRunsOnlyWhileItsButtonIsHeld) {
  HoldButton& pump = macros.pump();
  const QPointF at(10, 10);
  mouse(pump, QEvent::MouseButtonPress, at);
  ASSERT_NE(lastSetpoint<HoldPump>(), nullptr);
  EXPECT_DOUBLE_EQ(lastSetpoint<HoldPump>()->left, 1.0);
  EXPECT_DOUBLE_EQ(lastSetpoint<HoldPump>()->right, 1.0);
  mouse(pump, QEvent::MouseButtonRelease, at);
  EXPECT_FALSE(hold.holding());
  EXPECT_EQ(link.releases, 1);
}

TEST_F(TeleopTileTest, AMacroIsCancelledByLettingGoAndByAStop) {
  emit link.macros({{"arm park", "", 6.0, 0.0, ""}});
  models.flush();
  ASSERT_EQ(macros.rows().size(), 1U);
  MacroRow& row = *macros.rows().front();
  mouse(row, QEvent::MouseButtonPress, {10, 10});
  ASSERT_TRUE(hold.holding(HoldKind::Macro));
  mouse(row, QEvent::MouseButtonRelease, {10, 10});
  EXPECT_EQ(link.releases, 1);
  mouse(row, QEvent::MouseButtonPress, {10, 10});
  status.stop.latched = true;
  feed();  // the row is disabled by the stop
  EXPECT_FALSE(row.isEngaged());
  EXPECT_FALSE(hold.holding());
}

}  // namespace
}  // namespace kiln::gui
