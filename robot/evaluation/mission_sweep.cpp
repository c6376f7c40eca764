#include "robot/evaluation/mission_sweep.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "robot/evaluation/yard_calibration.h"
#include "robot/missions/catalog.h"

namespace kiln {

Result<void> addCalibration(MissionRunOptions& run) {
  std::string world = run.world;
  const MissionKind* kind = findMission(run.mission.empty() ? missionNames().front() : run.mission);
  if (world.empty() && kind) world = kind->default_world;
  const auto yard = yardOf(world);
  if (!yard) return tl::make_unexpected(yard.error());
  const auto file = calibrationOf(*yard, run.seed, calibrationCache());
  if (!file) return tl::make_unexpected(file.error());
  run.robot_args.insert(run.robot_args.end(), {"--calibration", *file});
  return {};
}

namespace {

/// The robot of a seed is calibrated once, before its day.
Result<MissionRun> runCalibrated(MissionRunOptions run, const SweepOptions& options) {
  if (options.calibrate) {
    if (auto told = addCalibration(run); !told) return tl::make_unexpected(told.error());
  }
  return runMission(run);
}

}  // namespace

std::vector<SeedResult> runSeeds(const SweepOptions& options, const std::string& mission,
                                 const std::vector<std::string>& robot_args) {
  const int count = std::max(0, options.last_seed - options.first_seed + 1);
  std::vector<SeedResult> results(static_cast<std::size_t>(count));
  std::atomic<int> next{0};
  std::vector<std::jthread> workers;
  for (int worker = 0; worker < std::max(1, options.jobs); ++worker) {
    workers.emplace_back([&] {
      for (int i = next++; i < count; i = next++) {
        MissionRunOptions run;
        run.mission = mission;
        run.seed = options.first_seed + i;
        run.trace = true;
        run.world = options.world;
        run.robot_args = robot_args;
        if (!options.localization.empty())
          run.robot_args.insert(run.robot_args.end(), {"--localization", options.localization});
        SeedResult& result = results[static_cast<std::size_t>(i)];
        result = {run.seed, runCalibrated(run, options)};
        fmt::print(
            stderr, "seed {:>3}: {}\n", run.seed,
            result.run ? (result.run->success ? "ok" : "FAILED") : result.run.error().message);
      }
    });
  }
  workers.clear();  // joins
  return results;
}

}  // namespace kiln
