// Random sequences of real pointer events against the whole window under a window manager: what is
// held on the robot is what a hand holds on the screen, and nothing else.
#include <QProcess>
#include <QStandardPaths>
#include <QTest>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "gui/app/main_window.h"
#include "gui/views/macros/macros_tile.h"
#include "gui/views/teleop/teleop_tile.h"
#include "robot/safety/dead_man.h"
#include "tests/gui/support/direct_link.h"
#include "tests/gui/support/x_pointer.h"

namespace kiln::gui {
namespace {

constexpr int kSettle_ms = 30, kAnswer_ms = 600;

class HoldEventsTest : public testing::Test {
 protected:
  HoldEventsTest() {
    manager.start(QStringLiteral("openbox"), {});
    manager.waitForStarted();
    theme.apply();
    window.resize(1400, 860);
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&window));
    link.open();
    link.runByTimer();
    QTest::qWait(300);
    models.lease.request();
    QTest::qWait(300);
    models.commands.send(SetMode{Mode::Teleop}, "teleop");
    QTest::qWait(500);
    EXPECT_TRUE(models.mayJog());
  }
  ~HoldEventsTest() override {
    hand.release();
    manager.kill();
    manager.waitForFinished();
  }

  struct Target {
    QWidget* widget;
    kiln::HoldKind kind;
  };
  [[nodiscard]] std::vector<Target> targets() {
    auto* macros = window.findChild<MacrosTile*>();
    auto* teleop = window.findChild<TeleopTile*>();
    std::vector<Target> out;
    if (macros->isVisible()) out.push_back({&macros->pump(), kiln::HoldKind::Pump});
    if (teleop->isVisible()) {
      out.push_back({&teleop->panel().drivePad(), kiln::HoldKind::BaseJog});
      out.push_back({&teleop->panel().armPad(), kiln::HoldKind::ArmJog});
    }
    return out;
  }
  /// Where a target is on the screen and how large: a press is over when this changes.
  [[nodiscard]] static QRect place(const QWidget& widget) {
    return {widget.mapTo(widget.window(), QPoint()), widget.size()};
  }
  [[nodiscard]] bool anyHeld() {
    for (const auto kind : {kiln::HoldKind::BaseJog, kiln::HoldKind::ArmJog, kiln::HoldKind::Pump,
                            kiln::HoldKind::Macro})
      if (link.robot().held(kind)) return true;
    return false;
  }
  void moveTo(const QPoint& global) { hand.moveTo(global.x(), global.y()); }
  /// What may move under a pressed pointer.
  void disturb(int what) {
    if (what == 0)
      window.resize(window.width() + (window.width() > 1390 ? -14 : 14), window.height());
    if (what == 1) window.resize(window.width(), window.height() > 895 ? 860 : 930);
    if (what == 2) window.showLog(what_log = !what_log);
    if (what == 3) theme.toggle();
    if (what == 4) models.alarms.setOwn("test", AlarmLevel::Warning, on = !on, "Test", "nothing");
  }

  QProcess manager;
  XPointer hand;
  DirectLink link{true};
  StationModels models{link};
  Theme theme;
  MainWindow window{{theme, link.clock()}, models, {RobotGeometry{}, false}};
  bool what_log = false, on = false;
};

TEST_F(HoldEventsTest, HeldOnTheRobotIfAndOnlyIfPressed) {
  if (QStandardPaths::findExecutable(QStringLiteral("openbox")).isEmpty())
    GTEST_SKIP() << "needs a window manager: openbox";
  const char* wanted = std::getenv("KILN_HOLDS");
  const int sequences = wanted ? std::atoi(wanted) : 200;
  std::mt19937 random(20261129);
  const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int held_seen = 0;
  for (int sequence = 0; sequence < sequences; ++sequence) {
    const std::vector<Target> all = targets();
    ASSERT_FALSE(all.empty());
    const Target target = all[static_cast<std::size_t>(draw(static_cast<int>(all.size())))];
    const QRect before = place(*target.widget);
    const QPoint inside(target.widget->width() / 4, target.widget->height() / 4);
    moveTo(target.widget->mapToGlobal(inside));
    QTest::qWait(kSettle_ms);
    std::string said = "press";
    hand.press();
    bool expected = target.widget->isEnabled();
    const bool pad = target.kind != kiln::HoldKind::Pump;  // a stick is followed beyond its edge
    for (int step = draw(4); step >= 0; --step) {
      QTest::qWait(kSettle_ms);
      switch (draw(4)) {
        case 0:
          moveTo(target.widget->mapToGlobal(inside + QPoint(draw(5) - 2, draw(5) - 2)));
          said += ", move inside";
          break;
        case 1:
          moveTo(target.widget->mapToGlobal(QPoint(-40, inside.y())));
          expected = expected && pad;
          said += ", move away";
          break;
        default: {
          const int what = draw(5);
          disturb(what);
          said += ", disturb " + std::to_string(what);
          break;
        }
      }
      QTest::qWait(kSettle_ms);
      if (!target.widget->isVisible() || place(*target.widget) != before) expected = false;
    }
    for (int ms = 0; ms < kAnswer_ms && link.robot().held(target.kind) != expected;
         ms += kSettle_ms)
      QTest::qWait(kSettle_ms);
    ASSERT_EQ(link.robot().held(target.kind), expected)
        << "sequence " << sequence << " on kind " << static_cast<int>(target.kind) << ": " << said;
    held_seen += expected ? 1 : 0;
    hand.release();
    for (int ms = 0; ms < kAnswer_ms && anyHeld(); ms += kSettle_ms) QTest::qWait(kSettle_ms);
    ASSERT_FALSE(anyHeld()) << "sequence " << sequence << " after its release: " << said;
  }
  EXPECT_GT(held_seen, sequences / 10) << "most presses were in vain: nothing was tried";
}

}  // namespace
}  // namespace kiln::gui
