#include <cstdio>
#include <filesystem>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "common/config/command_line.h"
#include "common/config/resources.h"
#include "common/core/atomic_file.h"
#include "common/core/check.h"
#include "common/core/log.h"
#include "robot/app/instance_lock.h"
#include "robot/app/robot.h"
#include "robot/app/run_loop.h"
#include "robot/app/runtime.h"
#include "robot/fsm/uuid.h"
#include "robot/missions/common/mission_checkpoint.h"

namespace {

using namespace kiln;

constexpr int kSuccess = 0, kMissionFailed = 1, kBadInput = 2;

struct Arguments {
  RobotOptions robot;
  std::string config;
  DeviceSources sources;
  std::string listen = "tcp://127.0.0.1:7300";
  std::string report;
  std::string localization;
  bool flat_ground = false;
  std::string record_dir;
  double replay_speed = 1.0;
  bool record = false;
  std::vector<std::string> overrides;
  bool exit_when_done = false;
  double until_s = 0.0;
  bool print_config = false;
  bool print_reference = false;
  bool list_missions = false;
  int log_level = 2;
};

int fail(const Error& error) {
  fmt::print(stderr, "kiln-robotd: {}\n", error.message);
  return kBadInput;
}

void addOptions(CLI::App& app, Arguments& a) {
  app.add_option("--sim", a.sources.sim, "endpoint of kiln-sim, e.g. ipc:///tmp/kiln-sim");
  app.add_option("--lidar", a.sources.lidar,
                 "show a recorded VLP-16 capture: pcap, or raw 1206-byte packets");
  app.add_option("--thermal", a.sources.thermal,
                 "show recorded Lepton stills from a folder, at 8.77 Hz");
  app.add_option("--set", a.overrides,
                 "KEY=VALUE over the config, e.g. fire.heat.detector.threshold_c=60; may be "
                 "repeated");
  app.add_option("--localization", a.localization, "how to locate (default: the config's)")
      ->check(CLI::IsMember({"surfel_map", "walls", "odometry"}));
  app.add_flag("--flat-ground", a.flat_ground,
               "the arena has no ramp and no edge (kiln-sim --world fire_flat; with "
               "--localization walls, the shipped map has both)");
  app.add_option("--mission", a.robot.mission, missionHelp())
      ->default_val(missionNames().front())
      ->check(CLI::IsMember(missionNames()));
  app.add_flag("--list-missions", a.list_missions,
               "print each mission's name, world and meaning, and end");
  app.add_flag("--start", a.robot.start, "start the mission as soon as all checks pass");
  app.add_flag("--resume", a.robot.resume, "go on from the checkpoint in the state folder");
  app.add_flag("--lockstep", a.robot.lockstep,
               "step together with kiln-sim --lockstep, as fast as possible");
  app.add_flag("--exit-when-done", a.exit_when_done,
               "end when the mission has ended; exit status 0 on success");
  app.add_option("--until-s", a.until_s,
                 "end after so many seconds of robot time, mission over or not (default: never)")
      ->check(within(0.1, 1e6));
  app.add_option(
      "--report", a.report,
      "write the mission report (JSON) at the end; wall times and slips of the loops go to "
      "FILE.timing");
  app.add_option("--record", a.record_dir,
                 "record this run, into this folder (default: recordings in the state folder)")
      ->expected(0, 1);
  app.add_option("--replay", a.sources.replay,
                 "run perception again on a recorded run (.mcap), then end");
  app.add_option("--replay-speed", a.replay_speed, "0.1 to 10; 0: as fast as possible")
      ->check(within(0.0, 10.0));
  app.add_option("--state-dir", a.robot.state_dir,
                 "checkpoint, pose and lock; default: $XDG_STATE_HOME/kiln or ~/.local/state/kiln");
  app.add_option("--listen", a.listen,
                 "where stations connect: tcp://127.0.0.1:PORT or ipc:///DIR/PREFIX")
      ->capture_default_str();
  app.add_option("--calibration", a.robot.calibration,
                 "mounting of the sensors, from kiln-eval calibrate (default: calibration.yaml in "
                 "the state folder, if there is one)")
      ->check(CLI::ExistingFile);
  app.add_option("--config", a.config, "robot config (default: resources/config/robot.yaml)");
  app.add_flag("--print-config", a.print_config,
               "print the effective configuration as YAML and end");
  app.add_flag("--print-config-reference", a.print_reference,
               "print every key with unit, range and meaning, and end");
  app.add_option("--log-level", a.log_level, "0 trace .. 4 error")->check(CLI::Range(0, 5));
}

std::string defaultStateFolder() {
  if (const char* state = std::getenv("XDG_STATE_HOME")) return std::string(state) + "/kiln";
  if (const char* home = std::getenv("HOME")) return std::string(home) + "/.local/state/kiln";
  return (std::filesystem::temp_directory_path() / "kiln-state").string();
}

Result<RobotSettings> loadSettings(const Arguments& a) {
  RobotSettings settings;
  const auto set = [&settings](const std::vector<std::string>& keys) -> Result<void> {
    for (const std::string& key : keys)
      if (auto done = overrideConfig(key, settings); !done) return done;
    return {};
  };
  const auto shipped = resourcePath("config/robot.yaml");
  if (!shipped && a.config.empty()) return tl::make_unexpected(shipped.error());
  if (a.config.empty())
    if (auto loaded = loadConfig(*shipped, settings); !loaded)
      return tl::make_unexpected(loaded.error());
  if (auto done = set(findMission(a.robot.mission)->settings); !done)
    return tl::make_unexpected(done.error());
  if (!a.config.empty())
    if (auto loaded = loadConfig(a.config, settings); !loaded)
      return tl::make_unexpected(loaded.error());
  if (auto done = set(a.overrides); !done) return tl::make_unexpected(done.error());
  if (!a.localization.empty()) settings.localization.method = a.localization;
  settings.flat_ground = settings.flat_ground || a.flat_ground;
  return settings;
}

Result<void> writeReports(const Arguments& a, const Robot& robot, const Executor& executor,
                          Stamp now) {
  if (a.report.empty()) return {};
  if (auto written = writeFileAtomically(a.report, robot.reportJson(now)); !written) return written;
  nlohmann::json timing{{"locate_s", robot.locateCosts()}};
  for (const TickStatistics& tick : executor.statistics()) {
    timing["ticks"][tick.name] = {
        {"count", tick.ticks}, {"slips", tick.slips}, {"worst_late_s", tick.worst_late_s}};
  }
  return writeFileAtomically(a.report + ".timing", timing.dump() + "\n");
}

/// The id under which hello, recording and mission are found: after a restart that of the mission
/// that goes on. A lockstep run must give the same report each time, so it is named by its world.
Result<std::string> missionUuid(const RobotOptions& options, const Runtime& runtime) {
  if (options.resume) {
    const auto saved = loadCheckpoint(options.state_dir + "/" + options.mission + ".checkpoint");
    if (!saved) return tl::make_unexpected(saved.error());
    return saved->fsm.mission_uuid;
  }
  if (runtime.sim && options.lockstep) return fmt::format("lockstep-{}", runtime.sim->world().seed);
  return randomUuid();
}

Result<std::unique_ptr<OperatorLink>> openLink(const Arguments& a, const RobotSettings& settings,
                                               const Clock& clock, StopLatch& stop) {
  OperatorLink::Config config = settings.link;
  config.endpoint = a.listen;
  config.robot_name = settings.name;
  return OperatorLink::open(config, {KILN_VERSION, a.robot.environment, a.robot.mission_uuid},
                            clock, stop);
}

std::unique_ptr<RunRecorder> makeRecorder(const Arguments& a, RobotSettings& settings,
                                          const Clock& clock, OperatorLink& link) {
  RunRecorder::Run run;
  run.folder = a.record_dir.empty() ? a.robot.state_dir + "/recordings" : a.record_dir;
  run.robot_name = settings.name;
  run.version = KILN_VERSION;
  run.mission_uuid = a.robot.mission_uuid;
  run.environment = a.robot.environment == Environment::Sim ? "sim" : "replay";
  run.config_yaml = dumpYaml(ConfigNode{[&](ConfigArchive& node) { settings.visit(node); }});
  run.lossless = a.robot.lockstep || !a.sources.replay.empty();
  auto recorder = std::make_unique<RunRecorder>(settings.recording, std::move(run), clock);
  link.setTap(recorder->tap());
  if (a.record) recorder->set(true);
  return recorder;
}

/// A bug of ours ends in the safe stop: the latch makes the control thread brake and cut the pumps
/// in its next ticks, before the process ends. Should that thread be the one that failed, the
/// devices' own watchdogs do it.
class CheckFailureGuard {
 public:
  CheckFailureGuard(StopLatch& stop, const Clock& clock) {
    setCheckFailureHandler([&stop, &clock](const std::string& what) {
      stop.set("internal check: " + what, clock.now());
      constexpr useconds_t kTimeToStop_us = 60'000;
      usleep(kTimeToStop_us);
    });
  }
  ~CheckFailureGuard() { setCheckFailureHandler({}); }
  CheckFailureGuard(const CheckFailureGuard&) = delete;
  CheckFailureGuard& operator=(const CheckFailureGuard&) = delete;
};

int printSettings(const Arguments& a) {
  auto settings = loadSettings(a);
  if (!settings) return fail(settings.error());
  const ConfigNode node{[&](ConfigArchive& archive) { settings->visit(archive); }};
  fmt::print("{}", a.print_reference ? referenceTable(node) : dumpYaml(node));
  return kSuccess;
}

Result<void> checkSources(const Arguments& a) {
  const DeviceSources& from = a.sources;
  const bool captures = !from.lidar.empty() || !from.thermal.empty();
  if (from.sim.empty() && from.replay.empty() && !captures) {
    return makeError(ErrorCode::InvalidInput,
                     "nothing to run on: give --sim ENDPOINT (a running kiln-sim), --replay FILE, "
                     "or --lidar FILE and --thermal FOLDER");
  }
  if (!from.replay.empty() && (captures || !from.sim.empty())) {
    return makeError(ErrorCode::InvalidInput,
                     "--replay stands alone: leave out the other sources of devices");
  }
  if (a.robot.lockstep && from.sim.empty())
    return makeError(ErrorCode::InvalidInput, "--lockstep needs --sim ENDPOINT");
  return {};
}

int listMissions() {
  for (const MissionKind& kind : missionKinds())
    fmt::print("{}\t{}\t{}\n", kind.name, kind.default_world, kind.doc);
  return kSuccess;
}

int run(Arguments a) {
  if (a.list_missions) return listMissions();
  if (a.print_config || a.print_reference) return printSettings(a);
  if (auto checked = checkSources(a); !checked) return fail(checked.error());
  auto settings = loadSettings(a);
  if (!settings) return fail(settings.error());
  if (a.robot.state_dir.empty()) a.robot.state_dir = defaultStateFolder();
  auto lock = InstanceLock::acquire(a.robot.state_dir);
  if (!lock) return fail(lock.error());

  a.sources.lockstep = a.robot.lockstep;
  Runtime runtime;
  if (auto opened = runtime.open(a.sources, KILN_VERSION); !opened) return fail(opened.error());
  a.robot.version = KILN_VERSION;
  if (runtime.run) a.robot.start_pose = runtime.run->startPose();
  a.robot.environment = runtime.sim ? Environment::Sim : Environment::Replay;
  StopLatch stop;
  const CheckFailureGuard guard(stop, runtime.clock());
  auto uuid = missionUuid(a.robot, runtime);
  if (!uuid) return fail(uuid.error());
  a.robot.mission_uuid = *uuid;
  auto link = openLink(a, *settings, runtime.clock(), stop);
  if (!link) return fail(link.error());
  const auto recorder = makeRecorder(a, *settings, runtime.clock(), **link);
  a.robot.recorder = recorder.get();
  auto robot = Robot::create(*settings, a.robot, runtime.devices(), runtime.clock(),
                             runtime.executor(), link->get(), stop);
  if (!robot) return fail(robot.error());

  const Stamp until = runtime.clock().now() + fromSeconds(a.until_s > 0.0 ? a.until_s : 1e9);
  const auto done = [&] {
    return (a.exit_when_done && (*robot)->missionEnded()) || runtime.clock().now() >= until;
  };
  if (runtime.run) {
    runReplay(*runtime.run, *runtime.manual, a.replay_speed, done);
  } else if (runtime.manual) {
    if (auto ran = runLockstep(*runtime.sim, runtime.manual_clock, *runtime.manual,
                               std::chrono::milliseconds(8), done);
        !ran) {
      return fail(ran.error());
    }
  } else {
    runtime.threads->start();
    runRealTime(done);
    // The stations shall see how it ended before the link goes.
    constexpr Duration kFarewell = std::chrono::seconds(3);
    const Stamp farewell = runtime.clock().now() + kFarewell;
    runRealTime([&] {
      const Stamp now = runtime.clock().now();
      return !a.exit_when_done || now >= farewell || now >= until;
    });
    runtime.threads->stop();
  }
  if (auto written = writeReports(a, **robot, runtime.executor(), runtime.clock().now()); !written)
    return fail(written.error());
  if (g_termination_signal != 0) return 128 + g_termination_signal;
  return !a.exit_when_done || (*robot)->missionSucceeded() ? kSuccess : kMissionFailed;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"kiln-robotd: autonomy, control and safety of one robot"};
  app.set_version_flag("--version", std::string("kiln-robotd ") + KILN_VERSION);
  addOptions(app, arguments);
  if (const auto status = parseCommandLine(app, argc, argv)) return *status;
  arguments.record = app.count("--record") > 0;
  setLogLevel(arguments.log_level);
  installSignalHandlers();
  return run(arguments);
}
