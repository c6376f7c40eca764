#include <QApplication>
#include <QDir>
#include <QSurfaceFormat>
#include <QTimer>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "common/config/resources.h"
#include "gui/app/main_window.h"
#include "gui/app/options.h"
#include "gui/app/screenshots.h"
#include "gui/app/stall_meter.h"
#include "gui/app/stop_probe.h"
#include "gui/app/tile_layout.h"
#include "gui/app/window_memory.h"
#include "gui/link/replay_link.h"
#include "gui/link/robot_link.h"
#include "gui/views/scene3d/scene_renderer.h"
#include "gui/views/scene3d/scene_tile.h"

namespace kiln::gui {
namespace {

std::atomic<bool> asked_to_quit = false;
void askToQuit(int) { asked_to_quit = true; }

/// A signal ends the event loop as closing the window does, so that holds are released and pictures
/// are written.
void quitOnSignal(QTimer& timer) {
  std::signal(SIGINT, askToQuit);
  std::signal(SIGTERM, askToQuit);
  QObject::connect(&timer, &QTimer::timeout, [] {
    if (asked_to_quit) QApplication::quit();
  });
  timer.start(100);
}

constexpr int kNoDisplay = 2;
constexpr int kLastLook_ms = 1500;

/// Qt aborts the process when no display answers; the operator gets a sentence instead.
bool haveDisplay() {
  const char* platform = std::getenv("QT_QPA_PLATFORM");
  if (platform && std::string(platform) != "xcb") return true;
  const char* x11 = std::getenv("DISPLAY");
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  return (x11 && *x11) || (wayland && *wayland);
}

Result<std::unique_ptr<Link>> makeLink(const StationOptions& options) {
  if (!options.replay.empty()) {
    auto replay = ReplayLink::open(options.replay);
    if (!replay) return tl::make_unexpected(replay.error());
    return std::unique_ptr<Link>(std::move(*replay));
  }
  auto live = std::make_unique<RobotLink>(
      RobotLink::Options{options.endpoint, options.operator_name, KILN_VERSION});
  if (const auto connected = live->connectToRobot(); !connected)
    return tl::make_unexpected(connected.error());
  return live;
}

int run(int argc, char** argv, const StationOptions& options) {
  QApplication app(argc, argv);
  QApplication::setApplicationName(QStringLiteral("kiln-station"));
  QApplication::setOrganizationName(QStringLiteral("kiln"));
  WindowMemory memory;
  Theme theme(options.theme.value_or(memory.theme()));
  theme.apply();
  RobotGeometry geometry;
  if (const auto path = resourcePath("robot_model/bob.yaml")) {
    if (const auto loaded = loadConfig(*path, geometry); !loaded) {
      std::cerr << "kiln-station: " << loaded.error().message << '\n';
      return EXIT_FAILURE;
    }
  } else {
    std::cerr << "kiln-station: " << path.error().message << '\n';
    return EXIT_FAILURE;
  }
  const auto made = makeLink(options);
  if (!made) {
    std::cerr << "kiln-station: " << made.error().message << '\n';
    return EXIT_FAILURE;
  }
  Link* const link = made->get();
  StationModels models(*link);
  const SteadyClock steady;
  MainWindow window(
      {theme, steady}, models,
      {geometry, !options.flat && openGlAvailable(), qobject_cast<ReplayLink*>(link)});
  memory.place(window, {options.width, options.height});
  window.tileLayout().choose(memory.choices());
  window.show();
  StallMeter stalls(steady);
  if (options.stall_report)
    QTimer::singleShot(kLastLook_ms, &stalls, [&stalls] { stalls.start(); });
  std::unique_ptr<Screenshots> screenshots;
  if (!options.screenshots.empty()) {
    const QDir folder(QString::fromStdString(options.screenshots));
    if (!folder.mkpath(QStringLiteral("."))) {
      std::cerr << "kiln-station: cannot create the folder " << options.screenshots
                << "; choose one that is writable\n";
      return EXIT_FAILURE;
    }
    screenshots = std::make_unique<Screenshots>(window, models, folder);
  }
  if (options.exit_when_done) {
    QObject::connect(&models.fsm, &FsmModel::stateEntered, &app, [&](const QString&) {
      if (models.fsm.status()->terminal)
        QTimer::singleShot(kLastLook_ms, &app, &QApplication::quit);
    });
  }
  if (options.take_lease) {
    // Until the clocks are matched the link refuses commands on the spot: ask until it is granted
    // once.
    QObject::connect(&models, &StationModels::aged, &models.lease,
                     [&models, granted = false]() mutable {
                       granted = granted || models.lease.mine();
                       const bool known = models.link.robotNow().has_value();
                       if (!granted && known && models.lease.holder() == LeaseHolder::Free &&
                           !models.lease.requesting()) {
                         models.lease.request();
                       }
                     });
  }
  std::unique_ptr<StopProbe> probe;
  if (options.measure_stop > 0) {
    probe = std::make_unique<StopProbe>(window, models, options.measure_stop);
    QObject::connect(probe.get(), &StopProbe::finished, &app, [&probe] {
      std::cout << "{\"key_to_latch_s\": [";
      for (std::size_t i = 0; i < probe->latchS().size(); ++i)
        std::cout << (i ? ", " : "") << probe->latchS()[i];
      std::cout << "]}" << std::endl;
      QApplication::quit();
    });
    QObject::connect(probe.get(), &StopProbe::failed, &app, [](const QString& reason) {
      std::cerr << "kiln-station: STOP key not timed: " << reason.toStdString() << std::endl;
      QApplication::exit(EXIT_FAILURE);
    });
  }
  QTimer signal_timer;
  quitOnSignal(signal_timer);
  link->open();
  const Stamp opened = steady.now();
  const int code = QApplication::exec();
  link->close();
  memory.keep(window, theme.kind(), window.tileLayout().choices());
  const bool pictures_written = !screenshots || screenshots->finish();
  if (options.stall_report) {
    const SceneCanvas& scene = window.sceneTile()->canvas();
    const double seconds = toSeconds(steady.now() - opened);
    std::cout << stalls.report().toStdString() << "\nscene: " << scene.pictures() << " pictures, "
              << static_cast<double>(scene.pictures()) / seconds << " a second, "
              << scene.meanRenderMs() << " ms each" << std::endl;
  }
  return pictures_written ? code : EXIT_FAILURE;
}

}  // namespace
}  // namespace kiln::gui

int main(int argc, char** argv) {
  kiln::gui::StationOptions options;
  if (const auto code = kiln::gui::parseOptions(argc, argv, options)) return *code;
  if (!kiln::gui::haveDisplay()) {
    std::cerr << "kiln-station: there is no display (DISPLAY and WAYLAND_DISPLAY are empty); log "
                 "in to a desktop or run "
                 "it under a virtual one: xvfb-run -a kiln-station ...\n";
    return kiln::gui::kNoDisplay;
  }
  return kiln::gui::run(argc, argv, options);
}
