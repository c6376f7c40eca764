#include <cstdio>

#include <nlohmann/json.hpp>

#include "common/config/command_line.h"
#include "common/config/resources.h"
#include "common/core/atomic_file.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/map_command.h"
#include "robot/evaluation/mission_sweep.h"
#include "robot/evaluation/trajectory_figure.h"
#include "robot/missions/catalog.h"

namespace {

using namespace kiln;

constexpr int kSuccess = 0, kMissed = 1, kBadInput = 2;
constexpr int kMostSeed = 1'000'000'000;

int fail(const Error& error) {
  fmt::print(stderr, "kiln-eval: {}\n", error.message);
  return kBadInput;
}

Result<void> writeFigure(const MissionRun& run, const std::string& path) {
  const auto arena = loadResource<ArenaMap>("config/arena_kitchen.yaml");
  if (!arena) return tl::make_unexpected(arena.error());
  const auto site = loadFireSite(*arena);
  if (!site) return tl::make_unexpected(site.error());
  return writeFileAtomically(path, trajectorySvg(run, *arena, *site));
}

int runOneMission(const MissionRunOptions& options, const std::string& report,
                  const std::string& figure) {
  auto run = runMission(options);
  if (!run) return fail(run.error());
  if (!figure.empty()) {
    if (auto written = writeFigure(*run, figure); !written) return fail(written.error());
  }
  if (!report.empty()) {
    if (auto written = writeFileAtomically(report, run->report_json); !written)
      return fail(written.error());
    const nlohmann::json timing{{"wall_s", run->wall_s},
                                {"real_time_factor", run->realTimeFactor()},
                                {"sim_cpu_s", run->sim_cpu_s},
                                {"robot_cpu_s", run->robot_cpu_s}};
    if (auto written = writeFileAtomically(report + ".timing", timing.dump(2) + "\n"); !written)
      return fail(written.error());
  } else {
    fmt::print("{}", run->report_json);
  }
  fmt::print(stderr, "{} in {:.1f} simulated s, {:.1f} x real time\n",
             run->success ? "success" : "FAILED", run->simulated_s, run->realTimeFactor());
  return run->success ? kSuccess : kMissed;
}

/// "3-7" or "5".
bool parseSeeds(const std::string& text, SweepOptions& options) {
  if (text.empty()) return true;
  int first = 0, last = 0;
  const int found = std::sscanf(text.c_str(), "%d-%d", &first, &last);
  if (found < 1 || first < 0 || (found == 2 && last < first)) return false;
  options.first_seed = first;
  options.last_seed = found == 2 ? last : first;
  return true;
}

/// tests/ lies beside resources/ in the source tree.
Result<std::vector<Goal>> goalsOf(const Evaluation& evaluation) {
  auto config = resourcePath("config");
  if (!config) return tl::make_unexpected(config.error());
  return loadGoals(*config + "/../../" + evaluation.goals);
}

void addOption(CLI::App& sub, const EvaluationOption& option, SweepOptions& sweep) {
  if (const auto* text = std::get_if<std::string SweepOptions::*>(&option.field)) {
    sub.add_option(option.flags, sweep.**text, option.doc);
  } else if (const auto* flag = std::get_if<bool SweepOptions::*>(&option.field)) {
    sub.add_flag(option.flags, sweep.**flag, option.doc);
  } else {
    const std::string name = option.flags.substr(option.flags.find_first_not_of('-'));
    sub.add_option_function<std::string>(
        option.flags, [&sweep, name](const std::string& value) { sweep.own[name] = value; },
        option.doc);
  }
}

int runEvaluation(const Evaluation& evaluation, const SweepOptions& options,
                  const std::string& json_path) {
  auto goal_list = goalsOf(evaluation);
  if (!goal_list) return fail(goal_list.error());
  auto result = evaluation.run(options);
  if (!result) return fail(result.error());
  bool all_ok = true;
  for (Metric& figure : result->figures) {
    judge(figure, result->goal_set.empty() ? result->name : result->goal_set, *goal_list);
    all_ok &= figure.ok;
  }
  fmt::print("{}", formatTable(*result));
  if (!json_path.empty()) {
    if (auto written = writeJson(*result, json_path); !written) return fail(written.error());
  }
  return all_ok ? kSuccess : kMissed;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "kiln-eval: runs missions and sweeps against the simulator and holds their figures against "
      "the goals"};
  app.set_version_flag("--version", std::string("kiln-eval ") + KILN_VERSION);
  app.require_subcommand(1);

  MissionRunOptions run_options;
  run_options.lockstep = false;
  std::string report, figure;
  auto* run = app.add_subcommand("run", "one mission; exit status 0 only on success");
  run->add_option("--mission", run_options.mission, missionHelp())
      ->default_val(missionNames().front())
      ->check(CLI::IsMember(missionNames()));
  run->add_option("--seed", run_options.seed, "seed of the world")
      ->default_val(1)
      ->check(wholeUpTo(kMostSeed));
  run->add_flag("--lockstep", run_options.lockstep,
                "world and robot step together, as fast as the processor allows");
  run->add_option("--report", report, "deterministic JSON; wall time goes to FILE.timing");
  run->add_option("--figure", figure, "draw the way planned, driven and true as SVG");
  run->add_option("--world", run_options.world, "world file (default: the mission's)")
      ->check(CLI::ExistingFile);
  run->add_option("--fault", run_options.world_args,
                  "fault to inject, as kiln-sim --fault takes it");
  run->add_option("--robot-arg", run_options.robot_args,
                  "passed on to kiln-robotd, e.g. --robot-arg=--localization=odometry");
  bool calibrate = false;
  run->add_flag("--calibrate", calibrate, "calibrate the sensors of this seed's robot first");
  run->add_option("--wall-limit-s", run_options.wall_limit_s, "end a run that takes longer")
      ->default_val(1200.0)
      ->check(within(1.0, 1e6));

  MapCommandOptions map_options;
  auto* map = app.add_subcommand("map", "builds the localisation map from recorded runs");
  map->add_option("recordings", map_options.recordings,
                  "of kiln-robotd --record; the first begins at the arena's start pose")
      ->required()
      ->check(CLI::ExistingFile);
  map->add_option("-o,--out", map_options.out, "map file")->required();
  map->add_option("--arena", map_options.arena, "resource: walls and start pose")
      ->capture_default_str();
  map->add_option("--geometry", map_options.geometry, "resource: the robot's geometry")
      ->capture_default_str();
  map->add_option("--pcd", map_options.pcd, "also write the surfels as PCD");
  map->add_option("--ply", map_options.ply, "also write the surfels as PLY");
  map->add_option("--json", map_options.json, "also write the report as JSON");

  auto* list = app.add_subcommand("list", "names the evaluations");
  std::string seeds, json_path;
  SweepOptions sweep;
  int jobs = 0;
  std::vector<std::pair<CLI::App*, const Evaluation*>> sweeps;
  for (const Evaluation& evaluation : evaluations()) {
    auto* sub = app.add_subcommand(evaluation.name, evaluation.doc);
    sub->add_option("--seeds", seeds, "A-B");
    sub->add_option("--json", json_path, "write figures and runs as JSON");
    sub->add_option("--jobs", jobs, "runs side by side")->check(CLI::Range(1, 64));
    for (const EvaluationOption& option : evaluation.options) addOption(*sub, option, sweep);
    sweeps.emplace_back(sub, &evaluation);
  }
  if (const auto status = parseCommandLine(app, argc, argv)) return *status;

  if (*list) {
    for (const Evaluation& evaluation : evaluations())
      fmt::print("{:<20} {}\n", evaluation.name, evaluation.doc);
    return kSuccess;
  }
  if (*map) {
    const auto made = makeMap(map_options);
    if (!made) return fail(made.error());
    fmt::print("{}", made->text);
    return kSuccess;
  }
  if (*run) {
    std::vector<std::string> faults;
    for (const std::string& fault : run_options.world_args)
      faults.insert(faults.end(), {"--fault", fault});
    run_options.world_args = faults;
    run_options.trace = !figure.empty();
    if (calibrate) {
      if (auto told = addCalibration(run_options); !told) return fail(told.error());
    }
    return runOneMission(run_options, report, figure);
  }
  for (const auto& [sub, evaluation] : sweeps) {
    if (!*sub) continue;
    SweepOptions options = sweep;
    options.first_seed = evaluation->defaults.first_seed;
    options.calibrate &= evaluation->defaults.calibrate;
    options.last_seed = evaluation->defaults.last_seed;
    options.jobs = jobs > 0 ? jobs : evaluation->defaults.jobs;
    if (!parseSeeds(seeds, options))
      return fail({ErrorCode::InvalidInput, "--seeds must be A-B with A <= B, e.g. 1-20"});
    return runEvaluation(*evaluation, options, json_path);
  }
  return kBadInput;
}
