// The toy in the window: its figure, layer, box, card and command, with nothing of gui/ changed.
#include <QTest>
#include <QToolButton>

#include <gmock/gmock.h>

#include "gui/app/main_window.h"
#include "gui/views/scene3d/scene_tile.h"
#include "gui/views/top_bar/top_bar.h"
#include "gui/widgets/act_button.h"
#include "tests/gui/views/scripted_link.h"
#include "tests/system/toy/toy_panel.h"
#include "tests/system/toy/toy_view.h"

namespace kiln::gui {
namespace {

struct ToyWindow : testing::Test {
  void tell(const MissionInfo& info) {
    emit link.missionInfo(std::make_shared<const MissionInfo>(info));
    LinkHealth health;
    health.state = LinkState::Up;
    emit link.health(health);
    RobotStatus status;
    status.stamp = link.time.now();
    status.figures = toy::figures(3);
    emit link.status(std::make_shared<const RobotStatus>(status));
    Scene scene;
    scene.stamp = link.time.now();
    scene.items = toy::items({1.0, 0.0, 0.0});
    emit link.scene(std::make_shared<const Scene>(scene));
    models.flush();
    emit models.aged();
  }
  ScriptedLink link;
  StationModels models{link};
  Theme theme;
  const std::vector<PanelKind> panels{toy::panel()};
  MainWindow window{{theme, link.clock()}, models, {RobotGeometry{}, false, nullptr, &panels}};
};

TEST_F(ToyWindow, ShowsItsFigureLayerBoxAndCard) {
  EXPECT_TRUE(window.sceneTile()->cards().empty());
  tell(toy::missionInfo());
  EXPECT_EQ(window.topBar()->missionFigures(), QStringList{"Drives 3"});
  const SceneSnapshot& scene = window.sceneTile()->state().snapshot();
  ASSERT_EQ(scene.mission_layers.size(), 1u);
  EXPECT_EQ(scene.mission_layers[0].spec.label, "Toy's goal");
  EXPECT_EQ(scene.items.size(), 1u);
  ASSERT_EQ(window.sceneTile()->cards().size(), 1u);
}

TEST_F(ToyWindow, ItsCardOpensByItsKeyAndSendsItsCommand) {
  tell(toy::missionInfo());
  window.show();
  QToolButton* key = nullptr;
  for (QToolButton* button : window.sceneTile()->findChildren<QToolButton*>())
    if (button->text() == "toy") key = button;
  ASSERT_NE(key, nullptr);
  key->click();
  SceneCard* card = window.sceneTile()->cards().at(0);
  EXPECT_TRUE(card->isVisible());
  card->findChild<ActButton*>()->click();
  ASSERT_EQ(link.sent.size(), 1u);
  EXPECT_EQ(std::get<MissionCommand>(link.sent[0]).name, toy::kPush);
}

TEST_F(ToyWindow, ARobotThatDeclaresTooMuchLeavesTheTopBarReadable) {
  MissionInfo info = toy::missionInfo();
  info.figures.assign(400, info.figures.front());
  info.panels.assign(40, info.panels.front());
  tell(info);
  EXPECT_EQ(window.sceneTile()->cards().size(), 1u) << "a panel that is named twice is one";
  EXPECT_EQ(window.topBar()->missionFigures().size(), 4);
}

TEST_F(ToyWindow, AnotherMissionTakesThePanelsWithIt) {
  tell(toy::missionInfo());
  MissionInfo other;
  other.mission = "other";
  other.panels = {"a panel of a newer robot"};
  tell(other);
  EXPECT_TRUE(window.sceneTile()->cards().empty());
  EXPECT_TRUE(window.topBar()->missionFigures().isEmpty());
  ASSERT_FALSE(models.log.lines().empty());
  EXPECT_THAT(models.log.lines().back().text, testing::HasSubstr("a panel of a newer robot"));
}

}  // namespace
}  // namespace kiln::gui
