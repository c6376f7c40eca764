#include "robot/evaluation/mission_run.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "common/core/clock.h"
#include "robot/evaluation/child_process.h"
#include "robot/evaluation/evaluation.h"
#include "robot/missions/catalog.h"

namespace kiln {
namespace {

using nlohmann::json;

std::string readAll(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Result<json> readJson(const std::string& path, const std::string& who, const std::string& log) {
  const json document = json::parse(readAll(path), nullptr, false);
  if (document.is_discarded() || !document.is_object()) {
    return makeError(ErrorCode::NotFound, "{} left no report; its last words:\n{}", who,
                     tailOf(log, 8));
  }
  return document;
}

struct Folder {
  explicit Folder(const MissionRunOptions& o) : scratch("eval"), options(o) {}
  ScratchFolder scratch;
  const MissionRunOptions& options;
  [[nodiscard]] std::string file(const std::string& name) const { return scratch.file(name); }

  [[nodiscard]] std::string program(const std::string& name) const {
    return options.programs.empty() ? siblingProgram(name) : options.programs + "/" + name;
  }
  [[nodiscard]] std::vector<std::string> worldCommand() const {
    std::vector<std::string> argv{program("kiln-sim"),
                                  "--seed",
                                  std::to_string(options.seed),
                                  "--listen",
                                  "ipc://" + file("world"),
                                  "--truth",
                                  file("truth.json")};
    if (options.lockstep) argv.emplace_back("--lockstep");
    if (!options.world.empty()) argv.insert(argv.end(), {"--world", options.world});
    if (options.trace) argv.insert(argv.end(), {"--truth-trace", file("trace.jsonl")});
    argv.insert(argv.end(), options.world_args.begin(), options.world_args.end());
    return argv;
  }
  [[nodiscard]] bool choosesLocalization() const {
    return std::any_of(
        options.robot_args.begin(), options.robot_args.end(),
        [](const std::string& argument) { return argument.starts_with("--localization"); });
  }
  [[nodiscard]] std::vector<std::string> robotCommand(bool resume) const {
    std::vector<std::string> argv{program("kiln-robotd"),
                                  "--sim",
                                  "ipc://" + file("world"),
                                  "--mission",
                                  options.mission,
                                  "--start",
                                  "--exit-when-done",
                                  "--report",
                                  file("robot.json"),
                                  "--state-dir",
                                  file("state"),
                                  "--listen",
                                  "ipc://" + file("link")};
    if (options.lockstep) argv.emplace_back("--lockstep");
    if (resume) argv.emplace_back("--resume");
    if (isFlat(options.world)) argv.emplace_back("--flat-ground");
    if (isFlat(options.world) && !choosesLocalization()) {
      argv.insert(argv.end(), {"--localization", "walls"});  // the shipped map has the ramp
    }
    argv.insert(argv.end(), options.robot_args.begin(), options.robot_args.end());
    return argv;
  }
};

json mergeReports(const MissionRunOptions& options, const json& robot, const json& truth,
                  bool& success) {
  const auto& collisions = truth.at("collisions");
  const std::string outcome = robot.value("outcome", "unknown");
  json report{{"mission", options.mission},
              {"seed", options.seed},
              {"version", KILN_VERSION},
              {"mission_outcome", outcome},
              {"reason", robot.value("reason", "")},
              {"simulated_s", truth.at("simulated_s")},
              {"mission_s", robot.value("mission_s", 0.0)},
              {"collisions", collisions},
              {"states", robot.at("states")},
              {"resets", truth.at("resets")},
              {"score", truth.at("score")}};
  const MissionRule* rule = missionRule(options.mission);
  std::string missed = rule ? rule->judge(robot, truth, report) : std::string();
  if (missed.empty() && !collisions.empty()) missed = "collision";
  success = outcome == "success" && missed.empty();
  report["outcome"] = outcome == "success" && !success ? missed : outcome;
  return report;
}

/// Follows the world's trace while it grows.
class TraceTail {
 public:
  explicit TraceTail(std::string path) : path_(std::move(path)) {}
  /// Where the base was in the newest whole line.
  [[nodiscard]] std::optional<Kill> newest() {
    if (!in_.is_open()) in_.open(path_);
    in_.clear();
    for (std::string part; std::getline(in_, part);) {
      line_ += part;
      if (in_.eof()) break;  // the rest is still to come
      const json sample = json::parse(line_, nullptr, false);
      line_.clear();
      if (sample.is_object())
        last_ = Kill{sample.at("t").get<double>(), sample.at("base").at("xyz_m").at(0)};
    }
    return last_;
  }

 private:
  std::string path_, line_;
  std::ifstream in_;
  std::optional<Kill> last_;
};

/// Kills the daemon at its time and starts it again. @return where that was; nullopt: not yet.
Result<std::optional<Kill>> killAndResume(const Folder& folder, TraceTail& tail,
                                          std::optional<ChildProcess>& robot) {
  const auto where = tail.newest();
  const Kill& wanted = *folder.options.kill;
  if (!where || (where->at_s < wanted.at_s && where->at_x_m < wanted.at_x_m)) return std::nullopt;
  robot->signal(SIGKILL);
  (void)robot->wait(std::chrono::seconds(5));
  auto again = ChildProcess::start(folder.robotCommand(true), folder.file("robotd.log"));
  if (!again) return tl::make_unexpected(again.error());
  robot.emplace(std::move(*again));
  return tail.newest();
}

}  // namespace

const MissionRule* missionRule(const std::string& mission) {
  for (const Evaluation& evaluation : evaluations())
    if (evaluation.rule.judge && evaluation.rule.mission == mission) return &evaluation.rule;
  return nullptr;
}

Result<MissionRun> runMission(const MissionRunOptions& asked) {
  MissionRunOptions options = asked;
  if (options.mission.empty()) options.mission = missionNames().front();
  const MissionKind* kind = findMission(options.mission);
  if (options.world.empty() && kind) options.world = kind->default_world;
  const Folder folder(options);
  const SteadyClock clock;
  const Stamp begin = clock.now();
  auto world = ChildProcess::start(folder.worldCommand(), folder.file("sim.log"));
  if (!world) return tl::make_unexpected(world.error());
  auto started = ChildProcess::start(folder.robotCommand(false), folder.file("robotd.log"));
  if (!started) return tl::make_unexpected(started.error());
  std::optional<ChildProcess> robot(std::move(*started));

  MissionRun run;
  TraceTail tail(folder.file("trace.jsonl"));
  const Stamp deadline = begin + fromSeconds(options.wall_limit_s);
  while (!robot->wait(std::chrono::milliseconds(options.kill && !run.killed ? 2 : 200))) {
    if (options.kill && !run.killed) {
      auto killed = killAndResume(folder, tail, robot);
      if (!killed) return tl::make_unexpected(killed.error());
      run.killed = *killed;
    }
    run.robot_cpu_s = robot->cpuSeconds().value_or(run.robot_cpu_s);
    run.sim_cpu_s = world->cpuSeconds().value_or(run.sim_cpu_s);
    if (!world->running()) {
      return makeError(ErrorCode::Unavailable, "kiln-sim ended early; its last words:\n{}",
                       tailOf(folder.file("sim.log"), 8));
    }
    if (clock.now() > deadline) {
      return makeError(ErrorCode::Timeout,
                       "seed {}: no end after {} s of wall time; robot's last words:\n{}",
                       options.seed, options.wall_limit_s, tailOf(folder.file("robotd.log"), 8));
    }
  }
  run.wall_s = toSeconds(clock.now() - begin);
  world->signal(SIGTERM);  // the world would stand and wait for the next robot
  (void)world->wait(std::chrono::seconds(5));
  auto robot_report = readJson(folder.file("robot.json"), "kiln-robotd", folder.file("robotd.log"));
  if (!robot_report) return tl::make_unexpected(robot_report.error());
  auto truth = readJson(folder.file("truth.json"), "kiln-sim", folder.file("sim.log"));
  if (!truth) return tl::make_unexpected(truth.error());
  try {
    run.report_json = mergeReports(options, *robot_report, *truth, run.success).dump(2) + "\n";
    run.simulated_s = truth->at("simulated_s").get<double>();
  } catch (const json::exception& e) {
    return makeError(ErrorCode::InvalidInput,
                     "the reports of kiln-sim and kiln-robotd do not fit this kiln-eval: {}",
                     e.what());
  }
  json robot_and_truth{{"robot", *robot_report}, {"truth", *truth}};
  run.robot_json = robot_and_truth.dump();
  const json timing = json::parse(readAll(folder.file("robot.json.timing")), nullptr, false);
  if (timing.is_object()) run.locate_s = timing.value("locate_s", std::vector<double>{});
  if (options.trace) run.trace_jsonl = readAll(folder.file("trace.jsonl"));
  run.checkpoint_json = readAll(folder.file("state/" + options.mission + ".checkpoint"));
  return run;
}

}  // namespace kiln
