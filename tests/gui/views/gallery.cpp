// Shows the views with sample data and leaves pictures of them: views_gallery DIR [light].
#include <QApplication>
#include <QDir>
#include <QEventLoop>
#include <QGridLayout>
#include <QTimer>
#include <cstdio>

#include "gui/views/scene3d/scene_tile.h"
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

struct Gallery {
  Theme theme;
  ScriptedLink link;
  StationModels models{link};
  SampleWorld world;
  QWidget window;
  SceneTile* scene = nullptr;
  QString folder;
  double t_s = 0.0;

  Gallery(ThemeKind kind, QString dir) : theme(kind), folder(std::move(dir)) {
    theme.apply();
    const Ui ui{theme, link.time};
    scene = new SceneTile(ui, models, world.robot(), openGlAvailable());
    auto* grid = new QGridLayout(&window);
    grid->addWidget(scene, 0, 0);
    window.resize(820, 640);
    window.show();
    window.activateWindow();
  }

  void feed(bool spraying) {
    link.time.advanceBy(std::chrono::milliseconds(100));
    t_s += 0.1;
    const Stamp now = link.time.now();
    const RobotStatus status = world.status(now, t_s);
    emit link.status(std::make_shared<RobotStatus>(status));
    emit link.cloud(world.cloud(status, 1800));
    emit link.scene(std::make_shared<Scene>(world.scene(now, status, spraying)));
    models.flush();
    emit models.aged();
  }

  void shot(const QString& name) {
    wait(900);
    const QString path = QDir(folder).filePath(name + ".png");
    if (!window.grab().save(path)) std::fprintf(stderr, "cannot write %s\n", qPrintable(path));
    std::printf("%s (render %.1f ms)\n", qPrintable(path), scene->canvas().lastRenderMs());
  }
};

}  // namespace

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  if (argc < 2) {
    std::fprintf(stderr, "usage: views_gallery DIR [light]\n");
    return 2;
  }
  const bool light = argc > 2 && std::string(argv[2]) == "light";
  QDir().mkpath(QString::fromLocal8Bit(argv[1]));
  Gallery gallery(light ? ThemeKind::Light : ThemeKind::Dark, QString::fromLocal8Bit(argv[1]));
  for (int i = 0; i < 40; ++i) gallery.feed(false);
  gallery.shot("scene_follow");
  gallery.feed(true);
  gallery.scene->canvas().setCameraMode(OrbitCamera::Mode::Top);
  gallery.shot("scene_top");
  gallery.scene->canvas().setCameraMode(OrbitCamera::Mode::Follow);
  gallery.link.time.advanceBy(std::chrono::milliseconds(4200));
  emit gallery.models.aged();
  gallery.shot("scene_stale");
  return 0;
}
