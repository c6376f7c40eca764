// "Put a fire out by hand" of resources/docs/operating.md, by real input events in the real window on
// a live world and daemon; what the person knows it has read in the window. The way through the door
// is known as it is drawn in the scene. The world's own truth says afterwards what it was worth.
#include <QApplication>
#include <QElapsedTimer>
#include <QProcess>
#include <QRegularExpression>
#include <QTest>
#include <cstdio>
#include <fstream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "gui/app/main_window.h"
#include "gui/link/robot_link.h"
#include "gui/panels/fire/thermal_tile.h"
#include "gui/views/macros/macros_tile.h"
#include "gui/views/scene3d/scene_renderer.h"
#include "gui/views/top_bar/top_bar.h"
#include "robot/evaluation/live_system.h"
#include "robot/evaluation/truth.h"
#include "tests/gui/by_hand/driver.h"
#include "tests/support/paths.h"

namespace kiln::gui {
namespace {

constexpr double kMost_s = 240.0, kLeast_l = 0.5;  // the goal
constexpr double kHotBy_s = 80.0;                  // since Request: what burns is hot by then
constexpr double kLeastLook_s = 10.0, kReady_s = 60.0, kMacro_s = 75.0;
constexpr int kPresses = 20;  // of the macro, should the window let go

struct Said {
  std::string trouble;  ///< empty: all went as the manual says
  double request_to_end_s = 0.0;
  std::string place;
};

/// The steps of the manual.
class Person {
 public:
  Person(MainWindow& window, bool talks)
      : window_(window), hand_(window), driver_(hand_, window), talks_(talks) {}

  Said putAFireOut() {
    const bool ready = hand_.waitFor(kReady_s, [&] {
      return top().contains(QStringLiteral("READY")) && !top().contains(QStringLiteral("NOT"));
    });
    if (!ready) return fail("the robot is not READY: " + top().toStdString());
    timer_.start();
    if (!hand_.click(QStringLiteral("Request"))) return fail("no key 'Request'");
    if (!awaitKey(QStringLiteral("Start mission"))) return fail("'Start mission' stays dark");
    hand_.hold(QStringLiteral("Start mission"), 1.3);
    if (!awaitKey(QStringLiteral("To Teleop"))) return fail("'To Teleop' stays dark");
    hand_.click(QStringLiteral("To Teleop"));
    if (!hand_.waitFor(5, [&] { return top().contains(QStringLiteral("TELEOP")); }))
      return fail("not in TELEOP");
    tell("in Teleop");
    if (driver_.setSpeed(55) < 45) return fail("the speed slider does not follow");
    for (const Pose2& via : {Pose2{2.5, 0, 0}, Pose2{7.4, 0, 0}})
      if (!driver_.driveTo(via, {0.3, 6 * kDeg, false}, 40)) return fail("not through the door");
    tell("inside");
    if (!driver_.driveTo({8.6, 1.6, 0}, {0.4, 8 * kDeg, false}, 20))
      return fail("not towards place 1");
    if (auto said = workAt(QStringLiteral("place 1"), QStringLiteral("spray fire 1"))) return *said;
    if (driver_.setSpeed(50) < 40) return fail("the speed slider does not follow");
    for (const Pose2& via : {Pose2{8.6, 0.6, 0}, Pose2{9.6, -0.6, -45 * kDeg}})
      if (!driver_.driveTo(via, {0.3, 8 * kDeg, false}, 25)) return fail("not towards place 2");
    if (auto said = workAt(QStringLiteral("place 2"), QStringLiteral("spray fire 2"))) return *said;
    return fail("nothing burns at either place");
  }

 private:
  [[nodiscard]] QString top() const { return hand_.read<TopBar>(); }
  bool awaitKey(const QString& words) {
    return hand_.waitFor(10, [&] { return hand_.button(words) != nullptr; });
  }
  void tell(const std::string& what) const {
    if (talks_) std::fprintf(stderr, "%6.1f s  %s\n", seconds(), what.c_str());
  }
  [[nodiscard]] double seconds() const {
    return timer_.isValid() ? 1e-3 * double(timer_.elapsed()) : 0.0;
  }
  [[nodiscard]] Said fail(const std::string& why) {
    hand_.letGo();
    return {why + "; the window says: " + top().toStdString(), seconds(), {}};
  }
  /// What the thermal tile says in large figures of a source that it takes for a fire.
  [[nodiscard]] std::optional<int> sourceC() const {
    static const QRegularExpression kPeak(QStringLiteral("Peak of the ?source\\s*([0-9]+)\\s*°C"));
    const auto found = kPeak.match(hand_.read<ThermalTile>());
    if (!found.hasMatch()) return std::nullopt;
    return found.captured(1).toInt();
  }
  /// nullopt: nothing burns here.
  std::optional<Said> workAt(const QString& place, const QString& macro) {
    driver_.setSpeed(25);
    if (!driver_.driveToWork(place, {0.06, 3 * kDeg}, 40))
      return fail("not to the work pose of " + place.toStdString());
    tell("at the work pose of " + place.toStdString());
    const bool burns = hand_.waitFor(std::max(kLeastLook_s, kHotBy_s - seconds()),
                                     [&] { return sourceC().has_value(); });
    tell(burns ? "a source of " + std::to_string(*sourceC()) + " °C" : "no source");
    if (!burns) return std::nullopt;
    return spray(place, macro);
  }
  Said spray(const QString& place, const QString& macro) {
    QString said;
    for (int press = 0; press < kPresses; ++press) {
      if (!awaitKey(macro)) return fail("the macro is dark");
      bool ran = false;
      hand_.holdUntil(macro, kMacro_s, [&] {
        said = hand_.read<MacrosTile>();
        ran = ran || said.contains(QStringLiteral("step "));
        return ran && said.contains(QStringLiteral("last macro:"));
      });
      tell(said.toStdString());
      if (said.contains(QStringLiteral("last macro: done")))
        return {{}, seconds(), place.toStdString()};
      if (!said.contains(QStringLiteral("cancelled"))) break;
    }
    return fail("the macro did not end well: " + said.toStdString());
  }
  MainWindow& window_;
  Hand hand_;
  Driver driver_;
  QElapsedTimer timer_;
  bool talks_;
};

/// @return the run as JSON, with what the truth says.
Result<nlohmann::json> run(int seed, bool flat, const std::string& picture) {
  auto live = LiveSystem::start(seed, {}, {}, binaryDir() + "/bin");
  if (!live) return tl::make_unexpected(live.error());
  const auto geometry = loadResource<RobotGeometry>("robot_model/bob.yaml");
  if (!geometry) return tl::make_unexpected(geometry.error());
  Theme theme;
  theme.apply();
  RobotLink link({(*live)->linkEndpoint(), "by hand", KILN_VERSION});
  if (auto connected = link.connectToRobot(); !connected)
    return tl::make_unexpected(connected.error());
  StationModels models(link);
  const SteadyClock steady;
  Said said;
  {
    MainWindow window({theme, steady}, models, {*geometry, !flat && openGlAvailable(), nullptr});
    window.setGeometry(0, 0, 1680, 1020);
    window.show();
    if (!QTest::qWaitForWindowActive(&window))
      return makeError(ErrorCode::NotFound,
                       "the window gets no focus; run it under a window manager (openbox)");
    link.open();
    said = Person(window, true).putAFireOut();
    if (!picture.empty()) window.grab().save(QString::fromStdString(picture));
  }
  link.close();
  auto truth_text = (*live)->finish();
  if (!truth_text) return tl::make_unexpected(truth_text.error());
  const auto truth = nlohmann::json::parse(*truth_text);
  const double litres = burningLitres(truth);
  return nlohmann::json{
      {"seed", seed},
      {"request_to_end_s", said.request_to_end_s},
      {"litres_on_fire", litres},
      {"collisions", truth.at("collisions")},
      {"place", said.place},
      {"trouble", said.trouble},
      {"reached", said.trouble.empty() && litres >= kLeast_l && said.request_to_end_s <= kMost_s}};
}

}  // namespace
}  // namespace kiln::gui

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  CLI::App options{"A fire is put out by hand: by real input events in the station's window."};
  int first = 1, last = 1;
  bool flat = false;
  std::string json_path, picture;
  options.add_option("--first-seed", first)->check(CLI::Range(0, 10000));
  options.add_option("--last-seed", last)->check(CLI::Range(0, 10000));
  options.add_flag("--flat", flat, "top view instead of 3D, for machines without a GPU");
  options.add_option("--json", json_path, "file for the report");
  options.add_option("--picture", picture, "PNG of the window at the end");
  CLI11_PARSE(options, argc, argv);
  QProcess manager;  // where there is one already it ends at once
  manager.start(QStringLiteral("openbox"), QStringList());
  nlohmann::json runs = nlohmann::json::array();
  bool all = true;
  for (int seed = first; seed <= last; ++seed) {
    const auto done = kiln::gui::run(seed, flat, picture);
    if (!done) {
      std::fprintf(stderr, "fire_by_hand: %s\n", done.error().message.c_str());
      return 2;
    }
    all = all && done->at("reached").get<bool>();
    std::printf("%s\n", done->dump().c_str());
    runs.push_back(*done);
  }
  if (!json_path.empty()) std::ofstream(json_path) << runs.dump(1) << '\n';
  manager.kill();
  manager.waitForFinished();
  return all ? 0 : 1;
}
