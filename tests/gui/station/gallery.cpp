// Leaves pictures of the whole window in states that a mission seldom shows:
// station_gallery DIR [light] [1366x768] [flat] [RUN.mcap]
#include <QApplication>
#include <QDir>
#include <QEventLoop>
#include <QTimer>
#include <cstdio>

#include "common/config/resources.h"
#include "gui/app/main_window.h"
#include "gui/link/replay_link.h"
#include "gui/panels/fire/place_panel.h"
#include "gui/views/alarm_strip/alarm_list.h"
#include "gui/views/scene3d/scene_renderer.h"
#include "gui/views/scene3d/scene_tile.h"
#include "robot/app/alarm_book.h"
#include "tests/gui/support/direct_link.h"

using namespace kiln;
using namespace kiln::gui;

namespace {

struct Wanted {
  QString folder, recording;
  ThemeKind kind = ThemeKind::Dark;
  QSize size{1680, 1020};
  bool flat = false;
};

void wait(int ms) {
  QEventLoop loop;
  QTimer::singleShot(ms, &loop, &QEventLoop::quit);
  loop.exec();
}

void shot(MainWindow& window, const Wanted& wanted, const QString& name) {
  wait(900);
  const QString path = QDir(wanted.folder).filePath(name + ".png");
  if (!window.grab().save(path)) std::fprintf(stderr, "cannot write %s\n", qPrintable(path));
  std::printf("%s\n", qPrintable(path));
}

struct Desk {
  explicit Desk(const Wanted& w) : wanted(w) {
    theme.apply();
    window.resize(w.size);
    window.show();
    link.open();
    pass(2.0);
    models.lease.request();
    pass(0.5);
  }
  static RobotGeometry geometry() {
    RobotGeometry out;
    if (const auto path = resourcePath("robot_model/bob.yaml")) {
      if (const auto loaded = loadConfig(*path, out); !loaded)
        std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
    }
    return out;
  }
  void pass(double seconds) {
    for (double left = seconds; left > 0; left -= 0.1) {
      link.advance(0.1);
      QCoreApplication::processEvents();
      models.flush();
    }
    emit models.aged();
    QCoreApplication::processEvents();
  }
  Wanted wanted;
  DirectLink link{true};
  StationModels models{link};
  Theme theme{wanted.kind};
  MainWindow window{
      {theme, link.clock()}, models, {geometry(), !wanted.flat && openGlAvailable(), nullptr}};
};

/// More than the strip can hold: standing, over, to acknowledge and acknowledged.
void showAlarms(Desk& desk, const Wanted& wanted) {
  AlarmBook& alarms = desk.link.robot().alarms();
  const auto raise = [&](const char* id, AlarmLevel level, const char* text, const char* action) {
    alarms.set(id, true, level, text, action, desk.link.robot().now());
    desk.pass(1.0);
  };
  raise("pump.current", AlarmLevel::Caution, "left pump without current",
        "check the tank; acknowledge; spray by hand with the other one");
  raise("lidar", AlarmLevel::Warning, "LiDAR silent for 2.1 s",
        "check its cable and power; drive by the cameras only");
  raise("watch", AlarmLevel::Warning,
        "STOP by motion watch: the wheels turn at 0.41 m/s although 0.20 m/s are commanded",
        "look at the wheels and at what the robot stands against, then clear the stop");
  raise("disk", AlarmLevel::Advisory, "little room for a recording", "make room");
  alarms.set("lidar", false, AlarmLevel::Warning, "LiDAR silent for 2.1 s", "",
             desk.link.robot().now());
  desk.pass(20.0);
  desk.window.alarmList()->toggle();
  desk.pass(0.5);
  shot(desk.window, wanted, "11-alarms");
  desk.window.alarmList()->toggle();
}

/// What an operator sees when it is not going well.
void showStates(Desk& desk, const Wanted& wanted) {
  desk.models.commands.send(SetMode{Mode::Teleop}, "teleop");
  desk.pass(1.0);
  shot(desk.window, wanted, "6-teleop");
  desk.models.stop.press();
  desk.pass(1.0);
  shot(desk.window, wanted, "7-stopped");
  desk.models.lease.request();
  desk.pass(0.5);
  desk.models.stop.clear();
  desk.pass(1.0);
  desk.window.forcedJump().arm();
  desk.pass(0.5);
  shot(desk.window, wanted, "8-jump-armed");
  desk.window.forcedJump().cancel();
  showAlarms(desk, wanted);
  desk.link.setSilent(true);
  desk.pass(8.0);
  shot(desk.window, wanted, "9-no-link");
  desk.models.stop.press();
  desk.pass(1.0);
  shot(desk.window, wanted, "10-stop-kept");
}

void showRobot(const Wanted& wanted) {
  Desk desk(wanted);
  TestRobot& robot = desk.link.robot();
  const std::vector<Check> fine = robot.checks;
  robot.checks[1] = {"LiDAR", false, "no scan for 2.1 s", "Check the LiDAR's cable and power."};
  robot.health = LocalizationHealth::Lost;
  desk.pass(0.5);
  shot(desk.window, wanted, "1-not-ready-lost");
  PosePlacer& placer = desk.window.sceneTile()->posePlacer();
  placer.start();
  placer.press(1.0, 0.6);
  placer.drag(2.4, 1.2);
  desk.pass(0.2);
  shot(desk.window, wanted, "2-set-pose");
  placer.cancel();
  robot.checks = fine;
  robot.health = LocalizationHealth::Good;
  robot.misplaced = {0.16, 0.09, 0.05};
  desk.models.commands.send(SetRecording{true}, "start recording");
  robot.startMission();
  desk.pass(30.0);
  shot(desk.window, wanted, "3-driving");
  desk.models.commands.send(ResetRobot{}, "reset");
  desk.pass(32.0);
  desk.window.sceneTile()->canvas().setCameraMode(OrbitCamera::Mode::Top);
  robot.health = LocalizationHealth::Degraded;
  desk.pass(3.0);
  shot(desk.window, wanted, "4-after-reset-misplaced");
  for (SceneCard* card : desk.window.sceneTile()->cards())
    if (auto* places = dynamic_cast<PlacePanel*>(card)) places->nudge().wishSensed();
  desk.window.sceneTile()->canvas().setCameraMode(OrbitCamera::Mode::Follow);
  desk.pass(1.0);
  shot(desk.window, wanted, "5-nudge");
  showStates(desk, wanted);
}

int showReplay(const Wanted& wanted) {
  auto link = ReplayLink::open(wanted.recording.toStdString());
  if (!link) {
    std::fprintf(stderr, "%s\n", link.error().message.c_str());
    return 1;
  }
  StationModels models(**link);
  Theme theme(wanted.kind);
  theme.apply();
  const SteadyClock steady;
  MainWindow window({theme, steady}, models,
                    {Desk::geometry(), !wanted.flat && openGlAvailable(), link->get()});
  window.resize(wanted.size);
  window.show();
  (*link)->open();
  wait(1500);
  const Playback& p = (*link)->playback();
  (*link)->seek(p.start + (p.end - p.start) / 2);
  wait(1500);
  shot(window, wanted, "6-replay");
  (*link)->close();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  if (argc < 2) {
    std::fprintf(stderr, "usage: station_gallery DIR [light] [WxH] [flat] [RUN.mcap]\n");
    return 2;
  }
  Wanted wanted;
  wanted.folder = QString::fromLocal8Bit(argv[1]);
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    int w = 0, h = 0;
    if (word == "light")
      wanted.kind = ThemeKind::Light;
    else if (word == "flat")
      wanted.flat = true;
    else if (std::sscanf(word.c_str(), "%dx%d", &w, &h) == 2)
      wanted.size = {w, h};
    else
      wanted.recording = QString::fromStdString(word);
  }
  QDir().mkpath(wanted.folder);
  if (!wanted.recording.isEmpty()) return showReplay(wanted);
  showRobot(wanted);
  return 0;
}
