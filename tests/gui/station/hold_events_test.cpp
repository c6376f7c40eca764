// Random sequences of real pointer events against the whole window under a window manager: what is
// held on the robot is what a hand holds on the screen, and nothing else.
#include <QProcess>
#include <QStandardPaths>
#include <QTest>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "gui/app/main_window.h"
#include "gui/app/tile_layout.h"
#include "gui/panels/fire/pump_panel.h"
#include "gui/views/macros/macros_tile.h"
#include "gui/views/teleop/teleop_tile.h"
#include "robot/safety/dead_man.h"
#include "tests/gui/support/direct_link.h"
#include "tests/gui/support/x_pointer.h"

namespace kiln::gui {
namespace {

// The rhythm of a hand, part of what is tried: nothing is awaited in it. An answer has a limit.
constexpr int kSettle_ms = 30, kAnswer_ms = 600;
constexpr int kStill = 8, kStill_ms = 5000;  // looks at a layout that stands; 10 ms apart
constexpr int kAttempts = 10;

/// Whether a press on one control is alive, told from the events that reach it alone.
class Press : public QObject {
 public:
  explicit Press(QWidget& control) : control_(control) { control.installEventFilter(this); }
  ~Press() override { control_.removeEventFilter(this); }
  [[nodiscard]] bool alive() {
    alive_ = alive_ && control_.isVisible() && placeOf(control_) == place_;
    return alive_;
  }
  void end() { alive_ = false; }

 protected:
  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonDblClick) {
      alive_ = control_.isEnabled();
      place_ = placeOf(control_);
    }
    if (event->type() == QEvent::EnabledChange && !control_.isEnabled()) alive_ = false;
    return false;
  }

 private:
  [[nodiscard]] static QRect placeOf(const QWidget& control) {
    return {control.mapTo(control.window(), QPoint()), control.size()};
  }
  QWidget& control_;
  QRect place_;
  bool alive_ = false;
};

/// Why the window has ended holds by itself.
class LettingGo {
 public:
  explicit LettingGo(HoldToRun& hold)
      : connection_(QObject::connect(&hold, &HoldToRun::tripped, [this](const QString& why) {
          if (!why.isEmpty()) why_ += (why_.empty() ? "" : "; ") + why.toStdString();
        })) {}
  ~LettingGo() { QObject::disconnect(connection_); }
  [[nodiscard]] const std::string& why() const { return why_; }
  /// By design a window that is not served for longer than a dead-man's time lets go: on a machine
  /// that is busy enough this is no fault.
  [[nodiscard]] bool busy() const { return why_.find("busy") != std::string::npos; }

 private:
  std::string why_;
  QMetaObject::Connection connection_;
};

class HoldEventsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (QStandardPaths::findExecutable(QStringLiteral("openbox")).isEmpty()) return;
    manager = std::make_unique<QProcess>();
    manager->start(QStringLiteral("openbox"), QStringList());
  }
  static void TearDownTestSuite() {
    if (!manager) return;
    manager->kill();
    manager->waitForFinished();
    manager = nullptr;
  }
  void SetUp() override {
    if (!manager) GTEST_SKIP() << "needs a window manager: apt-get install openbox";
    ASSERT_TRUE(QTest::qWaitFor([this] { return hand.managed(); }));
    theme.apply();
    open();
    link.open();
    link.runByTimer();
    ASSERT_TRUE(QTest::qWaitFor([this] { return models.status.status() != nullptr; }));
    models.lease.request();
    ASSERT_TRUE(QTest::qWaitFor([this] { return models.lease.mine(); }));
    models.commands.send(SetMode{Mode::Teleop}, "teleop");
    ASSERT_TRUE(QTest::qWaitFor([this] { return models.mayJog(); }));
  }
  ~HoldEventsTest() override { hand.release(); }

  void open() {
    window = std::make_unique<MainWindow>(Ui{theme, link.clock()}, models,
                                          MainWindow::Options{RobotGeometry{}, false});
    window->resize(1400, 930);
    window->show();
    EXPECT_TRUE(QTest::qWaitForWindowActive(window.get()));
  }
  struct Target {
    QWidget* widget;
    kiln::HoldKind kind;
  };
  [[nodiscard]] std::vector<Target> targets() {
    auto* macros = window->findChild<MacrosTile*>();
    auto* teleop = window->findChild<TeleopTile*>();
    std::vector<Target> out;
    if (macros->isVisible()) {
      out.push_back({&window->findChild<PumpPanel*>()->pump(), kiln::HoldKind::Actuator});
      for (MacroRow* row : macros->rows())
        if (row->macro().start_condition.empty()) out.push_back({row, kiln::HoldKind::Macro});
    }
    if (teleop->isVisible()) {
      out.push_back({&teleop->panel().drivePad(), kiln::HoldKind::BaseJog});
      out.push_back({&teleop->panel().armPad(), kiln::HoldKind::ArmJog});
    }
    return out;
  }
  [[nodiscard]] bool anyHeld() {
    for (const auto kind : {kiln::HoldKind::BaseJog, kiln::HoldKind::ArmJog,
                            kiln::HoldKind::Actuator, kiln::HoldKind::Macro})
      if (link.robot().held(kind)) return true;
    return false;
  }
  /// Waits until the window manager and the layout have done with it: a hold on a control that
  /// moves ends by design.
  [[nodiscard]] static bool standsStill(const QWidget& control) {
    QRect last;
    int still = 0;
    return QTest::qWaitFor(
        [&] {
          const QRect now(control.mapToGlobal(QPoint()), control.size());
          still = control.isVisible() && now == last ? still + 1 : 0;
          last = now;
          return still >= kStill;
        },
        kStill_ms);
  }
  void moveTo(const QPoint& global) { hand.moveTo(global.x(), global.y()); }
  /// What may move under a pressed pointer.
  void disturb(int what) {
    if (what == 0)
      window->resize(window->width() + (window->width() > 1390 ? -14 : 14), window->height());
    if (what == 1) window->resize(window->width(), window->height() > 895 ? 860 : 930);
    if (what == 2) window->showLog(what_log = !what_log);
    if (what == 3) theme.toggle();
    if (what == 4) models.alarms.setOwn("test", AlarmLevel::Warning, on = !on, "Test", "nothing");
  }

  static inline std::unique_ptr<QProcess> manager;
  XPointer hand;
  DirectLink link{true};
  StationModels models{link};
  Theme theme;
  std::unique_ptr<MainWindow> window;
  bool what_log = false, on = false;
};

TEST_F(HoldEventsTest, HeldOnTheRobotIfAndOnlyIfPressed) {
  const char* wanted = std::getenv("KILN_HOLDS");
  const int sequences = wanted ? std::atoi(wanted) : 200;
  std::mt19937 random(20261129);
  const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int held_seen = 0;
  std::map<std::string, int> trips;
  for (int sequence = 0; sequence < sequences; ++sequence) {
    const std::vector<Target> all = targets();
    ASSERT_FALSE(all.empty());
    const Target target = all[static_cast<std::size_t>(draw(static_cast<int>(all.size())))];
    const QPoint inside(target.widget->width() / 4, target.widget->height() / 4);
    moveTo(target.widget->mapToGlobal(inside));
    QTest::qWait(kSettle_ms);
    Press press(*target.widget);
    std::string said = "press";
    const auto tripped =
        QObject::connect(&window->hold(), &HoldToRun::tripped, [&](const QString& why) {
          press.end();
          if (!why.isEmpty()) ++trips[why.toStdString()];
        });
    hand.press();
    QTest::qWait(kSettle_ms);
    // A stick is followed beyond its edge.
    const bool pad = qobject_cast<JogPad*>(target.widget) != nullptr;
    for (int step = draw(4); step >= 0; --step) {
      switch (draw(4)) {
        case 0:
          moveTo(target.widget->mapToGlobal(inside + QPoint(draw(5) - 2, draw(5) - 2)));
          said += ", move inside";
          break;
        case 1:
          moveTo(target.widget->mapToGlobal(QPoint(-40, inside.y())));
          if (!pad) press.end();
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
      (void)press.alive();
    }
    const auto agreed = [&] { return link.robot().held(target.kind) == press.alive(); };
    EXPECT_TRUE(QTest::qWaitFor(agreed, kAnswer_ms))
        << "sequence " << sequence << " on kind " << static_cast<int>(target.kind) << ": " << said
        << (press.alive() ? ": pressed" : ": not pressed");
    held_seen += press.alive() ? 1 : 0;
    hand.release();
    EXPECT_TRUE(QTest::qWaitFor([&] { return !anyHeld(); }, kAnswer_ms))
        << "sequence " << sequence << " after its release: " << said;
    QObject::disconnect(tripped);
    if (HasFailure()) return;
  }
  for (const auto& [why, times] : trips)
    EXPECT_LT(times, sequences / 5) << "let go by the window itself: " << why;
  EXPECT_GT(held_seen, sequences / 4) << "most presses were in vain: nothing was tried";
}

TEST_F(HoldEventsTest, JogKeysDriveWhileTheMacrosAreInFront) {
  window->resize(1400, 800);
  window->tileLayout().showMacros(true);
  MacrosTile* macros = window->macrosTile();
  HoldButton& pump = window->findChild<PumpPanel*>()->pump();
  const auto held = [&](kiln::HoldKind kind) { return link.robot().held(kind); };
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    ASSERT_TRUE(standsStill(*macros) && standsStill(pump));
    moveTo(macros->mapToGlobal({60, 12}));
    hand.press();
    hand.release();
    ASSERT_TRUE(QTest::qWaitFor([&] { return macros->hasFocus(); }, kAnswer_ms));
    LettingGo let_go(window->hold());
    hand.key('w', true);
    const bool drives = QTest::qWaitFor([&] { return held(kiln::HoldKind::BaseJog); }, kAnswer_ms);
    moveTo(pump.mapToGlobal(pump.rect().center()));
    hand.press();  // water while it drives
    const bool sprays = QTest::qWaitFor([&] { return held(kiln::HoldKind::Actuator); }, kAnswer_ms);
    const bool both = drives && sprays && held(kiln::HoldKind::BaseJog);
    hand.release();
    hand.key('w', false);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !anyHeld(); }, kAnswer_ms));
    if (let_go.busy()) continue;  // as the operator is told: press again
    EXPECT_TRUE(both) << "drives " << drives << ", sprays " << sprays << "; the window let go: '"
                      << let_go.why() << "'";
    return;
  }
  FAIL() << "the machine is too busy for any hold";
}

TEST_F(HoldEventsTest, AWindowThatGoesWhilePressedLetsGo) {
  for (std::size_t i = 0; i < targets().size(); ++i) {
    const Target target = targets()[i];
    moveTo(target.widget->mapToGlobal({target.widget->width() / 4, target.widget->height() / 4}));
    QTest::qWait(kSettle_ms);
    hand.press();
    EXPECT_TRUE(QTest::qWaitFor([&] { return link.robot().held(target.kind); }, kAnswer_ms));
    window = nullptr;
    EXPECT_TRUE(QTest::qWaitFor([&] { return !anyHeld(); }, kAnswer_ms));
    hand.release();
    open();
  }
}

}  // namespace
}  // namespace kiln::gui
