// Shows the views with sample data and leaves pictures of them: views_gallery DIR [light].
#include <QApplication>
#include <QDir>
#include <QEventLoop>
#include <QGridLayout>
#include <QMouseEvent>
#include <QTimer>
#include <cstdio>

#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "gui/panels/fire/place_panel.h"
#include "gui/panels/fire/pump_panel.h"
#include "gui/panels/fire/thermal_tile.h"
#include "gui/views/camera/camera_tile.h"
#include "gui/views/macros/macros_tile.h"
#include "gui/views/scene3d/scene_tile.h"
#include "gui/views/teleop/teleop_tile.h"
#include "tests/gui/views/sample_world.h"
#include "tests/gui/views/scripted_link.h"

using namespace kiln;
using namespace kiln::gui;

namespace {

void wait(int ms) {
  QEventLoop loop;
  QTimer::singleShot(ms, &loop, &QEventLoop::quit);
  loop.exec();
}

/// The middle and right of the main window, at their sizes there.
struct Gallery {
  Theme theme;
  ScriptedLink link;
  StationModels models{link};
  HoldToRun hold{models};
  SampleWorld world;
  QWidget window;
  SceneTile* scene;
  TeleopTile* teleop;
  MacrosTile* macros;
  PumpPanel* pumps;
  QString folder;
  double t_s = 0.0;
  std::uint32_t frame = 0;
  Mode mode = Mode::Supervised;
  bool mine = false, spraying = false, pump_dry = false;
  MacroStatus macro;

  Gallery(ThemeKind kind, QString dir) : theme(kind), folder(std::move(dir)) {
    theme.apply();
    const Ui ui{theme, link.time};
    scene = new SceneTile(ui, models, world.robot(), openGlAvailable());
    teleop = new TeleopTile(ui, hold);
    macros = new MacrosTile(ui, hold);
    pumps = new PumpPanel(ui, hold);
    macros->setHands(pumps);
    scene->addCard(new PlacePanel(ui, models, &scene->canvas()));
    auto* grid = new QGridLayout(&window);
    grid->setContentsMargins(6, 6, 6, 6);
    grid->setSpacing(6);
    grid->addWidget(scene, 0, 0, 2, 2);
    grid->addWidget(new ThermalTile(ui, models), 2, 0);
    grid->addWidget(new CameraTile(ui, models), 2, 1);
    grid->addWidget(teleop, 0, 2);
    grid->addWidget(macros, 1, 2, 2, 1);
    grid->setColumnStretch(0, 1);
    grid->setColumnStretch(1, 1);
    grid->setRowStretch(1, 1);
    for (int column : {0, 1}) grid->setColumnMinimumWidth(column, 408);
    grid->setColumnMinimumWidth(2, 402);
    grid->setRowMinimumHeight(2, 190);
    window.resize(1230, 640);
    window.show();
    window.activateWindow();
    emit link.missionInfo(std::make_shared<MissionInfo>(world.mission()));
    emit link.macros(world.macros());
  }

  void feed(bool camera = true) {
    link.time.advanceBy(std::chrono::milliseconds(100));
    t_s += 0.1;
    const Stamp now = link.time.now();
    RobotStatus status = world.status(now, t_s);
    status.mode = mode;
    status.word = mode == Mode::Teleop ? StatusWord::Teleop : StatusWord::Supervised;
    if (mine) {
      status.lease.holder_client = "me";
      status.lease.holder_name = "Ada";
      status.lease.epoch = 3;
    }
    status.macro = macro;
    if (spraying) {
      WaterLevels water = world.water();
      water.duty = {1.0, 1.0};
      water.current_a = {2.1, pump_dry ? 0.2 : 2.0};
      status.figures = fire::figures(water, 4.2, 273.15 + 127.0);
    }
    LinkHealth health;
    health.state = LinkState::Up;
    health.rtt_s = 0.031;
    emit link.health(health);
    emit link.status(std::make_shared<RobotStatus>(status));
    emit link.cloud(world.cloud(status, 1800));
    emit link.scene(std::make_shared<Scene>(world.scene(now, status, spraying)));
    const ThermalImagePtr image = world.thermal(now, ++frame);
    emit link.thermal(image);
    emit link.missionStream(
        std::make_shared<MissionDetail>(wire::encodeDetail(world.heat(*image))));
    if (camera) emit link.image(world.picture(now, frame));
    models.flush();
    emit models.aged();
  }

  void feed(int count, bool camera = true) {
    for (int i = 0; i < count; ++i) feed(camera);
  }

  void shot(const QString& name) {
    wait(1200);
    const QString path = QDir(folder).filePath(name + ".png");
    if (!window.grab().save(path)) std::fprintf(stderr, "cannot write %s\n", qPrintable(path));
    std::printf("%s (render %.1f ms)\n", qPrintable(path), scene->canvas().lastRenderMs());
  }
};

void press(QWidget& target, const QPointF& at, QEvent::Type type) {
  QMouseEvent event(type, at, target.mapToGlobal(at.toPoint()), Qt::LeftButton,
                    type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton,
                    Qt::NoModifier);
  QCoreApplication::sendEvent(&target, &event);
}

}  // namespace

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  if (argc < 2) {
    std::fprintf(stderr, "usage: views_gallery DIR [light]\n");
    return 2;
  }
  const bool light = argc > 2 && std::string(argv[2]) == "light";
  QDir().mkpath(QString::fromLocal8Bit(argv[1]));
  Gallery g(light ? ThemeKind::Light : ThemeKind::Dark, QString::fromLocal8Bit(argv[1]));
  g.feed(30);
  g.shot("supervised");

  g.mine = true;
  g.mode = Mode::Teleop;
  g.feed(5);
  g.teleop->panel().setFocus();
  press(g.teleop->panel().drivePad(), {62, 22}, QEvent::MouseButtonPress);
  g.spraying = g.pump_dry = true;
  press(g.pumps->pump(), {40, 40}, QEvent::MouseButtonPress);
  g.feed(12);
  g.shot("teleop");

  press(g.teleop->panel().drivePad(), {62, 22}, QEvent::MouseButtonRelease);
  press(g.pumps->pump(), {40, 40}, QEvent::MouseButtonRelease);
  g.macro = {"spray fire 1", 2, 5, "spray steady", 0.46, ""};
  g.pump_dry = false;
  g.feed(24, false);
  g.scene->canvas().setCameraMode(OrbitCamera::Mode::Top);
  g.shot("macro_camera_frozen");

  g.scene->canvas().setCameraMode(OrbitCamera::Mode::Follow);
  g.link.time.advanceBy(std::chrono::milliseconds(4200));
  emit g.models.aged();
  g.shot("link_lost");
  return 0;
}
