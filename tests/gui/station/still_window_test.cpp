// Whatever a robot says, no control that a hand may be on its way to moves by a pixel.
#include <QSlider>
#include <QTest>
#include <QToolButton>
#include <algorithm>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "common/wire/fire/codec/fire_codec.h"
#include "gui/app/main_window.h"
#include "gui/app/tile_layout.h"
#include "gui/panels/fire/place_panel.h"
#include "gui/views/alarm_strip/alarm_list.h"
#include "gui/views/alarm_strip/alarm_strip.h"
#include "gui/views/macros/macros_tile.h"
#include "gui/views/scene3d/scene_tile.h"
#include "gui/views/state_card/state_card.h"
#include "gui/views/teleop/jog_pad.h"
#include "gui/views/teleop/teleop_tile.h"
#include "gui/views/top_bar/stop_button.h"
#include "gui/views/top_bar/top_bar.h"
#include "tests/gui/support/direct_link.h"

namespace kiln::gui {
namespace {

constexpr int kName = 64,
              kSentence = 200;  // characters; what comes over the wire is longer at no place

/// Words of `length` characters, none of them wider than a line.
std::string words(int length) {
  static const std::string kText = "Wammering weighbridge (W 8888.88 m) ";
  std::string out;
  while (static_cast<int>(out.size()) < length) out += kText;
  return out.substr(0, static_cast<std::size_t>(length));
}

enum class Say { Least, Most };

/// Where every control is in the window.
using Places = std::map<QString, QRect>;

/// What the robot tells, with every text at its shortest or longest. The situation stays.
class Speaker {
 public:
  Speaker(DirectLink& link, StationModels& models, std::string state)
      : link_(link), models_(models), state_(std::move(state)) {}
  /// What the robot has to say itself.
  void sayNothing() { say(Say::Least, kNone); }
  /// @param only  the one kind of text that is said so; negative: all.
  void say(Say how, int only = -1) {
    most_ = how == Say::Most;
    only_ = only;
    kind_ = 0;
    status();
    fsm();
    others();
    QCoreApplication::processEvents();
    models_.flush();
    emit models_.aged();
    QCoreApplication::processEvents();
  }
  [[nodiscard]] int kinds() const { return kind_; }

 private:
  /// Whether the next kind of text is said now; else it stays as the robot has it.
  [[nodiscard]] bool mine() {
    const int kind = kind_++;
    return only_ < 0 || only_ == kind;
  }
  void set(std::string& text, int length) const { text = most_ ? words(length) : std::string(); }
  void status() {
    RobotStatus s = link_.robot().status();
    if (mine()) set(s.reason, kSentence);
    if (mine()) set(s.stop.source, kName);
    if (mine()) set(s.robot_name, kName);
    if (mine() && !s.lease.requested_by_client.empty()) set(s.lease.requested_by_name, kName);
    if (mine()) {
      s.macro.running.clear();
      set(s.macro.last_result, kSentence);
    }
    if (mine() && !models_.macros.macros().empty()) {
      s.macro.running = models_.macros.macros()[0].name;
      set(s.macro.step_text, kSentence);
    }
    if (mine()) {
      s.recording.on = most_;
      set(s.recording.file, kName);
      set(s.recording.problem, kSentence);
    }
    if (mine()) {
      s.alarms.clear();
      for (int i = 0; most_ && i < 5; ++i)
        s.alarms.push_back({"still." + std::to_string(i), AlarmLevel::Warning, words(kSentence),
                            words(kSentence), s.stamp, i < 4, i % 2 == 0});
    }
    if (mine()) {
      const double far = most_ ? -88888.88 : 0.0;
      s.X_map_base = {far, far, most_ ? -3.1 : 0.0};
      s.twist = {far, far, far};
      s.battery_v = most_ ? 8888.8 : 0.0;
      s.speed_scale = most_ ? 1.0 : 0.05;
      s.mission_elapsed_s = most_ ? 88888.0 : 0.0;
      s.mission_limit_s = most_ ? 88888.0 : 900.0;
      for (kiln::Figure& figure : s.figures)
        figure.value = most_ ? -888888.8 : std::numeric_limits<double>::quiet_NaN();
    }
    emit link_.status(std::make_shared<const RobotStatus>(s));
  }
  void fsm() {
    FsmStatus s = link_.robot().fsmStatus();
    if (!state_.empty()) s.state = state_;
    if (mine()) set(s.display_text, kSentence);
    if (mine()) set(s.blocked, kSentence);
    if (mine()) {
      s.guards.clear();
      for (int i = 0; most_ && i < 6; ++i) s.guards.push_back({words(40), false, words(80), 12.5});
    }
    if (mine())
      for (GuardStatus& guard : s.guards) {
        set(guard.detail, kSentence);
        guard.input_age_s = most_ ? 1234.5 : 0.0;
      }
    const bool renamed = mine();
    FsmInfo info = link_.robot().fsmInfo();
    if (renamed) {
      info.mission_uuid = s.mission_uuid = most_ ? "most" : "least";
      set(info.mission, kName);
      for (FsmEdgeInfo& edge : info.edges) set(edge.consequence, kSentence);
      for (FsmStateInfo& state : info.states) {
        state.label = most_ ? words(40) : "W";
        set(state.not_enterable_reason, kSentence);
      }
    }
    emit link_.fsmInfo(std::make_shared<const FsmInfo>(info));
    emit link_.fsmStatus(std::make_shared<const FsmStatus>(s));
  }
  void others() {
    LocalizationStatus where = link_.robot().localization();
    if (mine()) {
      set(where.reason, kSentence);
      set(where.submap, kName);
    }
    emit link_.localization(std::make_shared<const LocalizationStatus>(where));
    std::vector<MacroInfo> macros = link_.robot().macros();
    if (mine())
      for (MacroInfo& macro : macros) {
        set(macro.doc, kSentence);
        set(macro.uses, kName);
        set(macro.start_condition, kSentence);
        macro.duration_s = most_ ? 88888.0 : 0.0;
      }
    emit link_.macros(macros);
    LinkHealth health = models_.link_state.health();
    if (mine()) {
      health.reason = QString::fromStdString(most_ ? words(kSentence) : "");
      health.rtt_s = most_ ? 0.31 : 0.0;
      health.loss = most_ ? 1.0 : 0.0;
    }
    emit link_.health(health);
    if (mine() && most_) emit link_.log({{link_.robot().now(), 4, words(kName), words(2000)}});
  }

  DirectLink& link_;
  StationModels& models_;
  static constexpr int kNone = 1000;
  const std::string state_;
  bool most_ = false;
  int only_ = -1, kind_ = 0;
};

class StillWindowTest : public testing::TestWithParam<QSize> {
 protected:
  StillWindowTest() {
    theme.apply();
    window.resize(GetParam());
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
    link.open();
    pass(2.0);
    models.lease.request();
    pass(0.5);
  }
  void pass(double seconds) {
    for (double left = seconds; left > 0; left -= 0.1) {
      link.advance(0.1);
      QCoreApplication::processEvents();
      models.flush();
      emit models.aged();
    }
  }
  /// Those of a class are told apart by where they stand: some are made anew for other words.
  [[nodiscard]] Places places() const {
    std::map<QString, std::vector<QRect>> by_class;
    const auto note = [&](const QWidget& control, const QString& name) {
      // "Acknowledge" comes with its alarm, at a place that is kept for it.
      const bool passes = control.parentWidget() == window.alarmStrip() &&
                          control.x() < window.alarmStrip()->width() - 150;
      if (control.isVisible() && !passes && !window.alarmList()->isAncestorOf(&control))
        by_class[name].emplace_back(control.mapTo(&window, QPoint()), control.size());
    };
    const auto& exits = window.stateCard()->exits();
    for (const auto* button : window.findChildren<QAbstractButton*>()) {
      const bool exit = std::find(exits.begin(), exits.end(), button) != exits.end();
      note(*button, exit ? QStringLiteral("exit") : button->metaObject()->className());
    }
    for (const auto* pad : window.findChildren<JogPad*>()) note(*pad, "pad");
    for (const auto* slider : window.findChildren<QSlider*>()) note(*slider, "slider");
    note(*window.topBar()->stopButton(), "STOP");
    Places out;
    for (auto& [name, rects] : by_class) {
      std::sort(rects.begin(), rects.end(), [](const QRect& a, const QRect& b) {
        return std::pair(a.y(), a.x()) < std::pair(b.y(), b.x());
      });
      for (std::size_t i = 0; i < rects.size(); ++i)
        out[QStringLiteral("%1 %2").arg(name).arg(i)] = rects[i];
    }
    return out;
  }
  void expectStill(const Places& before, const std::string& what) const {
    const Places now = places();
    for (const auto& [name, place] : before) {
      const auto found = now.find(name);
      if (found == now.end()) {
        ADD_FAILURE() << what << ": " << name.toStdString() << " is gone";
        continue;
      }
      EXPECT_TRUE(found->second == place)
          << what << ": " << name.toStdString() << " moved by " << found->second.x() - place.x()
          << ", " << found->second.y() - place.y() << " px and grew by "
          << found->second.width() - place.width() << ", "
          << found->second.height() - place.height() << " px";
    }
    EXPECT_EQ(now.size(), before.size()) << what << ": a control has come";
  }
  /// @param state  of the mission that is told; empty: its own.
  void expectStillWhateverIsSaid(const std::string& situation, std::size_t controls,
                                 const std::string& state = {}) {
    pass(0.3);
    Speaker speaker(link, models, state);
    speaker.sayNothing();
    const Places natural = places();
    EXPECT_GE(natural.size(), controls) << situation << ": nothing is tried";
    for (const Say how : {Say::Most, Say::Least}) {
      speaker.say(how);
      expectStill(natural, situation + (how == Say::Most ? ", most" : ", least"));
      for (int kind = 0; kind < speaker.kinds(); ++kind) {
        speaker.say(how, kind);
        expectStill(natural, situation + (how == Say::Most ? ", most of " : ", least of ") +
                                 std::to_string(kind));
        if (HasFailure()) return;
      }
    }
  }
  DirectLink link{true};
  StationModels models{link};
  Theme theme;
  MainWindow window{{theme, link.clock()}, models, {RobotGeometry{}, false}};
};

TEST_P(StillWindowTest, InAutonomy) {
  link.robot().startMission();
  pass(1.0);
  ASSERT_EQ(models.status.word(), StatusWord::Auto);
  expectStillWhateverIsSaid("autonomy", 25);
}

TEST_P(StillWindowTest, WithFourWaysOut) {
  link.robot().startMission();
  pass(0.5);
  expectStillWhateverIsSaid("four ways out", 25, "SpraySteady");
  EXPECT_EQ(window.stateCard()->exits().size(), 4U);
}

TEST_P(StillWindowTest, InTeleopBesidePads) {
  link.robot().startMission();
  window.tileLayout().showMacros(false);
  pass(0.5);
  const Places driving_itself = places();
  models.commands.send(SetMode{Mode::Teleop}, "teleop");
  pass(1.0);
  ASSERT_EQ(models.status.word(), StatusWord::Teleop);
  const Places driven = places();
  for (const auto& [name, place] : driving_itself)
    if (name.startsWith("pad") || name.startsWith("slider") || name.startsWith("STOP"))
      EXPECT_TRUE(driven.at(name) == place) << name.toStdString() << " moved by the mode";
  expectStillWhateverIsSaid("Teleop", 25);
  window.tileLayout().showMacros(true);
  expectStillWhateverIsSaid("Teleop, macros in front", 25);
}

TEST_P(StillWindowTest, WhilePausedAndWhileStopped) {
  link.robot().startMission();
  pass(0.5);
  models.commands.send(Pause{}, "pause");
  pass(1.0);
  ASSERT_EQ(models.status.word(), StatusWord::Paused);
  expectStillWhateverIsSaid("paused", 25);
  link.robot().stop("Benjamin");
  pass(0.5);
  ASSERT_EQ(models.status.word(), StatusWord::Stopped);
  expectStillWhateverIsSaid("stopped", 25);
}

TEST_P(StillWindowTest, BeforeAStartWhateverTheChecksSay) {
  const auto before = places();
  for (const int length : {0, 20, 200}) {
    link.robot().checks[1] = {"LiDAR", length == 0, words(length), words(length)};
    link.robot().checks[2] = {words(40), length != 200, words(length), words(length), true};
    pass(0.5);
    expectStill(before, "checks of " + std::to_string(length));
  }
}

TEST_P(StillWindowTest, WhicheverStateAJumpIsAskedFor) {
  link.robot().startMission();
  pass(1.0);
  ASSERT_TRUE(window.forcedJump().arm());
  pass(0.1);
  const Places armed = places();
  int picked = 0;
  for (const FsmStateInfo& state : models.fsm.info()->states) {
    if (!window.forcedJump().pick(QString::fromStdString(state.name))) continue;
    pass(0.1);
    expectStill(armed, "jump to " + state.name);
    ++picked;
  }
  EXPECT_GT(picked, 3);
}

TEST_P(StillWindowTest, WhateverThePlaceCardSays) {
  link.robot().startMission();
  pass(1.0);
  window.tileLayout().bringToFront(*window.sceneTile());
  PlacePanel* card = nullptr;
  for (SceneCard* any : window.sceneTile()->cards())
    if (auto* found = dynamic_cast<PlacePanel*>(any)) card = found;
  ASSERT_NE(card, nullptr);
  card->toggle();
  pass(0.2);
  ASSERT_TRUE(card->isVisible());
  const Places before = places();
  const auto still = [&](const std::string& what) {
    pass(0.2);
    expectStill(before, what);
  };
  card->nudge().add(0.02, -0.02, 0.01);
  still("a wish");
  card->nudge().confirm();
  still("an answer");
  Scene scene = link.robot().scene();
  auto site = wire::decodeFireSite(scene.detail.data);
  ASSERT_TRUE(site);
  ASSERT_FALSE(site->places.empty());
  for (const FirePlaceInfo& place : site->places) {
    PlaceCheck check;
    check.place = place.name;
    check.verdict = PlaceVerdict::Misplaced;
    check.reason = words(kSentence);
    site->place_checks.push_back(check);
  }
  scene.detail = wire::encodeDetail(*site);
  emit link.scene(std::make_shared<const Scene>(scene));
  still("a long reason");
  card->nudge().cancel();
  still("no wish");
}

/// Neither the jog keys' own words nor the speed's.
TEST_P(StillWindowTest, WhateverTheJogPanelIsToldToDo) {
  window.tileLayout().showMacros(false);
  pass(0.2);
  const auto before = places();
  for (QToolButton* mode : window.findChild<TeleopTile*>()->panel().findChildren<QToolButton*>()) {
    mode->click();
    pass(0.1);
    for (const auto& [name, place] : places()) {  // the stick that goes up is hidden for a joint
      const bool known = std::any_of(before.begin(), before.end(),
                                     [&](const auto& was) { return was.second == place; });
      EXPECT_TRUE(known) << mode->text().toStdString() << ": " << name.toStdString() << " moved";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, StillWindowTest,
                         testing::Values(TileLayout::kLeast, QSize(1280, 690), QSize(1366, 768),
                                         QSize(1680, 1020)));

}  // namespace
}  // namespace kiln::gui
