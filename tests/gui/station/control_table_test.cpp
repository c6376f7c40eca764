// Every control of the window in every situation of the robot and of the lease: what is lit is not
// refused, what is dark says why, and each situation has a way out in the window.
#include <QTest>
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "gui/views/fsm_graph/fsm_tile.h"
#include "gui/views/fsm_graph/jump_panel.h"
#include "gui/views/macros/macros_tile.h"
#include "gui/views/state_card/state_card.h"
#include "gui/views/teleop/teleop_tile.h"
#include "gui/views/top_bar/top_bar.h"
#include "gui/widgets/act_button.h"
#include "tests/gui/station/stepped_station.h"
#include "tests/support/fake_devices.h"

namespace kiln::gui {
namespace {

/// The tiles that command, on a robot of their own.
struct Desk {
  Desk() {
    for (QWidget* tile : tiles()) {
      tile->resize(420, 420);
      tile->show();
    }
    station.pass(0.5);
  }
  [[nodiscard]] std::vector<QWidget*> tiles() { return {&bar, &graph, &card, &teleop, &macros}; }
  CommandAck other(const CommandBody& body) {
    return station.link.robot().ask("another-station", "Ben", body);
  }
  [[nodiscard]] std::vector<ActButton*> controls() {
    std::vector<ActButton*> out;
    for (QWidget* tile : tiles())
      for (ActButton* button : tile->findChildren<ActButton*>())
        if (button->isVisible()) out.push_back(button);
    return out;
  }
  void act(ActButton& button) {
    auto* held = qobject_cast<HoldButton*>(&button);
    QTest::mousePress(&button, Qt::LeftButton);
    if (held) {
      station.pass(1.2);
      held->tick();
    }
    QTest::mouseRelease(&button, Qt::LeftButton);
    station.pass(0.3);
  }
  SteppedStation station{true};
  Theme theme;
  Ui ui{theme, station.link.clock()};
  ForcedJump jump{station.models};
  HoldToRun hold{station.models};
  TopBar bar{ui, station.models};
  FsmTile graph{ui, station.models, jump};
  StateCard card{ui, station.models, jump};
  TeleopTile teleop{ui, hold};
  MacrosTile macros{ui, hold};
};

enum class Holder { Free, Mine, Other };

using Prepare = std::function<void(Desk&)>;
const std::map<std::string, Prepare> kSituations{
    {"fresh", [](Desk&) {}},
    {"not ready",
     [](Desk& d) {
       d.station.link.robot().checks[1] = {"LiDAR", false, "no scan", "cable"};
     }},
    {"running", [](Desk& d) { d.station.startMission(); }},
    {"paused",
     [](Desk& d) {
       d.station.startMission();
       d.other(Pause{});
     }},
    {"Teleop, no mission", [](Desk& d) { d.other(SetMode{Mode::Teleop}); }},
    {"Teleop, mission held",
     [](Desk& d) {
       d.station.startMission();
       d.other(SetMode{Mode::Teleop});
     }},
    {"stopped",
     [](Desk& d) {
       d.station.startMission();
       d.station.link.robot().stop("Ben");
     }},
    {"stopped in Teleop",
     [](Desk& d) {
       d.other(SetMode{Mode::Teleop});
       d.station.link.robot().stop("Ben");
     }},
    {"position lost",
     [](Desk& d) {
       d.station.startMission();
       d.station.link.robot().health = LocalizationHealth::Lost;
     }},
    {"protective stop",
     [](Desk& d) { d.station.link.robot().arm().setSafety(ArmSafetyMode::ProtectiveStop); }},
};

void prepare(Desk& desk, const std::string& situation, Holder holder) {
  desk.other(AcquireLease{});
  kSituations.at(situation)(desk);
  desk.station.pass(0.3);
  desk.other(ReleaseLease{});
  desk.station.pass(0.3);
  if (holder == Holder::Mine) desk.station.takeLease();
  if (holder == Holder::Other) desk.other(AcquireLease{});
  desk.station.pass(0.5);
}

std::string nameOf(const ActButton& button) {
  return button.text().toStdString() + " / " + button.toolTip().toStdString();
}

class ControlTable : public testing::TestWithParam<std::tuple<std::string, Holder>> {};

TEST_P(ControlTable, WhatIsLitWorksAndWhatIsDarkSaysWhy) {
  const auto& [situation, holder] = GetParam();
  std::size_t count = 0;
  {
    Desk desk;
    prepare(desk, situation, holder);
    count = desk.controls().size();
    for (const ActButton* button : desk.controls())
      EXPECT_TRUE(button->isEnabled() || !button->toolTip().isEmpty())
          << "dark without a word: " << nameOf(*button);
  }
  int lit = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Desk desk;
    prepare(desk, situation, holder);
    ASSERT_EQ(desk.controls().size(), count);
    ActButton& button = *desk.controls()[i];
    if (!button.isEnabled()) continue;
    ++lit;
    const std::size_t before = desk.station.models.commands.commands().size();
    const std::string name = nameOf(button);
    desk.act(button);
    const auto& commands = desk.station.models.commands.commands();
    for (std::size_t n = before; n < commands.size(); ++n)
      EXPECT_FALSE(commands[n].bad()) << name << ": " << commands[n].name.toStdString() << " "
                                      << commands[n].reason.toStdString();
  }
  EXPECT_GT(lit, 0) << "no way out";
}

/// What an operator presses who wants the mission to run, whatever stands in the way.
const char* const kWay[] = {
    "Request",     "Take over",     "Clear stop",    "Release protective stop",
    "To autonomy", "Start mission", "Resume mission"};

TEST_P(ControlTable, ThereIsAWayFromHereToARunningMission) {
  const auto& [situation, holder] = GetParam();
  Desk desk;
  const std::vector<Check> fine = desk.station.link.robot().checks;
  prepare(desk, situation, holder);
  desk.station.link.robot().checks = fine;
  desk.station.link.robot().health = LocalizationHealth::Good;
  desk.station.pass(1.0);
  std::string pressed;
  const auto runs = [&] { return desk.station.models.status.word() == StatusWord::Auto; };
  for (int step = 0; step < 8 && !(runs() && desk.station.models.lease.mine()); ++step) {
    const auto controls = desk.controls();
    ActButton* next = nullptr;
    for (const char* title : kWay)
      for (ActButton* button : controls)
        if (!next && button->isEnabled() && button->text() == QLatin1String(title)) next = button;
    ASSERT_TRUE(next) << "stuck after: " << pressed;
    pressed += next->text().toStdString() + ", ";
    desk.act(*next);
    if (holder == Holder::Other) desk.other(ReleaseLease{});  // Ben gives it when he is asked
    desk.station.pass(1.0);
  }
  EXPECT_TRUE(runs()) << "after: " << pressed;
}

INSTANTIATE_TEST_SUITE_P(Situations, ControlTable,
                         testing::Combine(testing::ValuesIn([] {
                                            std::vector<std::string> names;
                                            for (const auto& [name, prepare] : kSituations)
                                              names.push_back(name);
                                            return names;
                                          }()),
                                          testing::Values(Holder::Free, Holder::Mine,
                                                          Holder::Other)));

}  // namespace
}  // namespace kiln::gui
