#include "gui/views/teleop/teleop_tile.h"

#include <QLineEdit>

#include "gui/panels/fire/pump_panel.h"
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
  auto* panel = new PumpPanel(ui, hold);
  macros.setHands(panel);
  panel->show();
  HoldButton& pump = panel->pump();
  const QPointF at(10, 10);
  mouse(pump, QEvent::MouseButtonPress, at);
  ASSERT_NE(lastSetpoint<HoldActuator>(), nullptr);
  EXPECT_EQ(lastSetpoint<HoldActuator>()->name, kPumps);
  EXPECT_DOUBLE_EQ(lastSetpoint<HoldActuator>()->value, 1.0);
  mouse(pump, QEvent::MouseButtonRelease, at);
  EXPECT_FALSE(hold.holding());
  EXPECT_EQ(link.releases, 1);
}

TEST_F(TeleopTileTest, MacrosThatUseSomethingUpComeFirst) {
  emit link.macros({{"arm park", "", 6.0, "", ""},
                    {"spray fire 1", "", 18.0, "", "est. 0.9 l"},
                    {"spray fire 2", "", 18.0, "", "est. 0.9 l"}});
  models.flush();
  ASSERT_EQ(macros.rows().size(), 3U);
  EXPECT_EQ(macros.rows()[0]->macro().name, "spray fire 1");
  EXPECT_EQ(macros.rows()[1]->macro().name, "spray fire 2");
}

TEST_F(TeleopTileTest, AMacroIsCancelledByLettingGoAndByAStop) {
  emit link.macros({{"arm park", "", 6.0, "", ""}});
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

TEST_F(TeleopTileTest, AMacroGoesOnWhereItWasAndBeginsAnewByItsOwnKey) {
  emit link.macros({{"arm park", "", 6.0, "", ""}});
  models.flush();
  MacroRow& row = *macros.rows().front();
  mouse(row, QEvent::MouseButtonPress, {10, 10});
  ASSERT_NE(lastSetpoint<HoldMacro>(), nullptr);
  EXPECT_FALSE(lastSetpoint<HoldMacro>()->restart);
  mouse(row, QEvent::MouseButtonRelease, {10, 10});
  mouse(row.restart(), QEvent::MouseButtonPress, {10, 10});
  EXPECT_TRUE(lastSetpoint<HoldMacro>()->restart);
  EXPECT_EQ(lastSetpoint<HoldMacro>()->name, "arm park");
  mouse(row.restart(), QEvent::MouseButtonRelease, {10, 10});
  EXPECT_FALSE(hold.holding());
}

TEST_F(TeleopTileTest, AMacrosStepIsCountedAsTheRobotCountsIt) {
  emit link.macros({{"arm park", "", 6.0, "", ""}});
  status.macro = {"arm park", 1, 3, "arm to park", 0.1, ""};
  feed();
  EXPECT_TRUE(macros.rows().front()->line().startsWith("step 1 of 3"))
      << macros.rows().front()->line().toStdString();
}

TEST_F(TeleopTileTest, NoWordMovesAControl) {
  emit link.macros(
      {{"arm park", "", 6.0, "", ""}, {"spray fire 1", "", 18.0, "near", "est. 0.9 l"}});
  feed();
  for (int i = 0; i < 5; ++i) QCoreApplication::processEvents();  // new rows are laid out in steps
  const auto places = [&] {
    std::vector<QRect> out;
    for (const QWidget* control : window.findChildren<QWidget*>()) {
      if (!control->inherits("kiln::gui::ActButton") && !control->inherits("kiln::gui::JogPad") &&
          !control->inherits("QSlider"))
        continue;
      out.push_back({control->mapTo(&window, QPoint()), control->size()});
    }
    return out;
  };
  const auto before = places();
  const auto expectStill = [&](const char* when) {
    QCoreApplication::processEvents();
    EXPECT_EQ(places(), before) << when;
  };
  status.macro.last_result =
      "failed: the base is 3.43 m and 12 deg off the work pose of place 1; drive there first";
  feed();
  expectStill("a macro has failed");
  link.time.advanceBy(std::chrono::seconds(2));
  feed(false);
  emit models.aged();
  expectStill("no fresh view");
  hold.releaseAll("the robot has ended this hold: let go and press again");
  expectStill("let go by force");
  health.rtt_s = 0.2;
  feed();
  expectStill("a slow link");
  status.lease = {};
  feed();
  expectStill("the lease is gone");
}

TEST_F(TeleopTileTest, ARowThatMovesUnderTheHandLetsGo) {
  emit link.macros({{"arm park", "", 6.0, "", ""}});
  models.flush();
  QCoreApplication::processEvents();
  mouse(*macros.rows().front(), QEvent::MouseButtonPress, {10, 10});
  ASSERT_TRUE(hold.holding(HoldKind::Macro));
  window.layout()->setContentsMargins(0, 60, 0, 0);
  QCoreApplication::processEvents();
  EXPECT_FALSE(hold.holding());
}

}  // namespace
}  // namespace kiln::gui
