#include "robot/evaluation/pile_evaluation.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "robot/evaluation/lockstep_world.h"
#include "robot/evaluation/wall/pile_trial.h"
#include "robot/evaluation/yard_calibration.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr Duration kStep = std::chrono::milliseconds(8);
constexpr double kTrusted = 0.7, kWrong_m = 0.05;
constexpr double kNearest_m = 3.0, kStand_m = 0.3;  // the base's middle before the pile's front
constexpr int kStands = 4;

/// What a robot in that world is told of it.
struct KnownWorld {
  const char *name, *arena, *robot;
};
constexpr std::array kWorlds{
    KnownWorld{"wall_lab", "config/arena_wall_lab.yaml", "robot_model/mario.yaml"}};

Result<KnownWorld> known(const std::string& world) {
  const std::string name = std::filesystem::path(world).stem();
  for (const KnownWorld& w : kWorlds)
    if (name == w.name) return w;
  return makeError(ErrorCode::InvalidInput,
                   "world '{}' has no pile that this evaluation knows; take wall_lab", world);
}

Eigen::Isometry3d poseFrom(const json& j) {
  const auto &p = j.at("xyz_m"), &q = j.at("wxyz");
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(p[0], p[1], p[2]);
  X.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  return X;
}
Pose2 pose2From(const json& j) { return {j.at("x_m"), j.at("y_m"), j.at("yaw_rad")}; }

/// The pile as it truly stood, for brick_trial's comparison. Bricks stand in the layout's order.
BrickTrial truthOf(const json& truth, const BrickTarget& target) {
  BrickTrial trial;
  trial.target = target;
  trial.X_world_base = poseFrom(truth.at("final_base"));
  const json& wall = truth.at("wall");
  trial.scene.X_world_target = toIsometry(pose2From(wall.at("pile")));
  trial.scene.database = target.bricks;
  for (const TargetBrick& brick : target.bricks) {
    const json& told = wall.at("bricks").at(static_cast<std::size_t>(brick.id));
    trial.scene.bricks.push_back({brick.id, brick.kind, BrickFate::InPlace,
                                  poseFrom(told.at("pose")), brickSize(brick.kind)});
    trial.scene.fates.push_back(BrickFate::InPlace);
  }
  return trial;
}

Result<RobotGeometry> robotOf(const KnownWorld& world, int seed, bool calibrated) {
  auto robot = loadResource<RobotGeometry>(world.robot);
  if (!robot || !calibrated) return robot;
  const auto yard = yardOf(world.name);
  if (!yard) return tl::make_unexpected(yard.error());
  const auto file = calibrationOf(*yard, seed, calibrationCache());
  if (!file) return tl::make_unexpected(file.error());
  return loadCalibrated(*file, *robot);
}

Result<PileLook> look(SimLink& link, ManualClock& clock, const RobotGeometry& robot,
                      ArenaMap& arena, const PileLookOptions& options) {
  const auto site = loadWallSite(arena);
  if (!site) return tl::make_unexpected(site.error());
  arena.fixtures[kWallSite] = site->fixtures();
  clock.advanceTo(link.world().now);
  const auto step = [&]() -> Result<void> {
    clock.advanceBy(kStep);
    return link.advanceTo(clock.now());
  };
  WallRig rig(robot, arena, {link.arm(), link.base(), link.lidar(), clock, step});
  if (auto begun = rig.begin(); !begun) return tl::make_unexpected(begun.error());
  return lookAtPile(rig, robot, arena, *site, options);
}

void judge(PileRun& run, const PileLook& look, const json& truth) {
  const BrickTrial trial = truthOf(truth, look.target);
  const std::vector<BrickOutcome> outcomes = compare(trial, look.sight.bricks);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const BrickOutcome& o = outcomes[i];
    if (look.plan.cells[i] > 0.0) run.cells_ratio.push_back(o.evidence.found / look.plan.cells[i]);
    const bool trusts = o.confidence > kTrusted;
    if (trusts && o.error_m > kWrong_m) ++run.wrong;
    if (o.evidence.expected < BrickPoseEstimator::Config{}.min_expected) continue;
    ++run.seen;
    if (!trusts) continue;
    ++run.trusted;
    run.position_m.push_back(o.error_m);
    run.yaw_deg.push_back(o.yaw_error_deg);
  }
  const TargetError rough = compareTarget(trial, look.sight.target.X_base_target);
  run.rough_off_m = rough.position_m;
  run.rough_off_deg = rough.yaw_deg;
  // The wheels' map begins where the robot was thought to start.
  const Pose2 off = inverse(pose2From(truth.at("wall").at("pile"))) * pose2From(truth.at("start")) *
                    look.X_start_pile;
  run.found_off_m = std::hypot(off.x_m, off.y_m);
  run.found_off_deg = std::abs(off.yaw_rad) / kDeg;
}

Result<double> neededCells(const SweepOptions& options) {
  const auto given = options.own.find("needed-cells");
  if (given == options.own.end()) return 0.0;
  constexpr double kMost = 1e5;
  const std::string& text = given->second;
  double n = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc() || end != text.data() + text.size() || !(n >= 1.0 && n <= kMost))
    return makeError(ErrorCode::InvalidInput, "--needed-cells must be 1 to {:.0f}, not '{}'", kMost,
                     text);
  return n;
}

std::vector<double> joined(const std::vector<PileRun>& runs, std::vector<double> PileRun::*list) {
  std::vector<double> out;
  for (const PileRun& run : runs) out.insert(out.end(), (run.*list).begin(), (run.*list).end());
  return out;
}

std::vector<Metric> figuresOf(const std::vector<PileRun>& runs) {
  const auto total = [&](auto&& of) {
    double sum = 0.0;
    for (const PileRun& run : runs) sum += of(run);
    return sum;
  };
  const auto list = [&](std::vector<double> PileRun::*of) { return joined(runs, of); };
  const auto each = [&](double PileRun::*of) {
    std::vector<double> out;
    for (const PileRun& run : runs)
      if (run.refused.empty()) out.push_back(run.*of);
    return out;
  };
  const double seen = total([](const PileRun& r) { return r.seen; });
  const double perceived = total([](const PileRun& r) { return r.refused.empty() ? 1 : 0; });
  const auto position = list(&PileRun::position_m), yaw = list(&PileRun::yaw_deg);
  const auto share = [](double a, double b) { return b > 0.0 ? a / b : 0.0; };
  return {{"piles", static_cast<double>(runs.size()), "", "", true},
          {"refused", static_cast<double>(runs.size()) - perceived, "", "", true},
          {"found_median_m", median(each(&PileRun::found_off_m)), "m", "", true},
          {"found_median_deg", median(each(&PileRun::found_off_deg)), "deg", "", true},
          {"rough_median_m", median(each(&PileRun::rough_off_m)), "m", "", true},
          {"rough_median_deg", median(each(&PileRun::rough_off_deg)), "deg", "", true},
          {"position_median_m", median(position), "m", "", true},
          {"position_p95_m", quantile(position, 0.95), "m", "", true},
          {"yaw_median_deg", median(yaw), "deg", "", true},
          {"yaw_p95_deg", quantile(yaw, 0.95), "deg", "", true},
          {"trusted_share", share(total([](const PileRun& r) { return r.trusted; }), seen), "", "",
           true},
          {"confidence_wrong", total([](const PileRun& r) { return r.wrong; }), "", "", true},
          {"sweeps_mean",
           share(total([](const PileRun& r) { return static_cast<double>(r.gather_s.size()); }),
                 perceived),
           "", "", true},
          {"sweep_max_s", quantile(list(&PileRun::gather_s), 1.0), "s", "", true},
          {"line_gap_median_deg", median(list(&PileRun::line_gap_deg)), "deg", "", true},
          {"uncovered", total([](const PileRun& r) { return r.uncovered; }), "", "", true},
          {"cells_of_expected_median", median(list(&PileRun::cells_ratio)), "", "", true},
          {"plan_median_s", median(each(&PileRun::plan_s)), "s", "", true},
          {"collisions_total", total([](const PileRun& r) { return r.collisions; }), "", "", true}};
}

}  // namespace

Result<PileRun> runPile(const std::string& world, int seed, bool calibrated, double needed_cells) {
  const auto what = known(world);
  if (!what) return tl::make_unexpected(what.error());
  const auto robot = robotOf(*what, seed, calibrated);
  if (!robot) return tl::make_unexpected(robot.error());
  auto arena = loadResource<ArenaMap>(what->arena);
  if (!arena) return tl::make_unexpected(arena.error());
  ManualClock clock;
  auto sim = LockstepWorld::start("pile", seed, world, clock);
  if (!sim) return tl::make_unexpected(sim.error());
  PileLookOptions options;
  options.stand_m = kNearest_m + kStand_m * (seed % kStands);
  options.views.needed_cells = needed_cells;
  const auto looked = look((*sim)->link(), clock, *robot, *arena, options);
  const auto truth = (*sim)->end();
  if (!truth) return tl::make_unexpected(truth.error());
  PileRun run;
  run.collisions = static_cast<int>(truth->value("collisions", json::array()).size());
  if (!looked) {
    run.refused = looked.error().message;
    return run;
  }
  run.plan_s = looked->plan_s;
  run.uncovered = static_cast<int>(looked->plan.uncovered.size());
  for (const SweepCloud& cloud : looked->clouds) {
    run.gather_s.push_back(toSeconds(cloud.end - cloud.begin) + LidarSweep::Config{}.scan_period_s);
    run.line_gap_deg.push_back(cloud.coverage.line_gap_deg);
    run.sweeps.push_back(cloud.text());
  }
  judge(run, *looked, *truth);
  return run;
}

json toJson(const PileRun& run, int seed) {
  if (!run.refused.empty())
    return {{"seed", seed}, {"refused", run.refused}, {"collisions", run.collisions}};
  return {{"seed", seed},
          {"position_m", run.position_m},
          {"yaw_deg", run.yaw_deg},
          {"seen", run.seen},
          {"trusted", run.trusted},
          {"wrong", run.wrong},
          {"uncovered", run.uncovered},
          {"cells_of_expected", run.cells_ratio},
          {"gather_s", run.gather_s},
          {"sweeps", run.sweeps},
          {"found_off_m", run.found_off_m},
          {"found_off_deg", run.found_off_deg},
          {"rough_off_m", run.rough_off_m},
          {"rough_off_deg", run.rough_off_deg},
          {"plan_s", run.plan_s},
          {"collisions", run.collisions}};
}

Result<EvaluationResult> evaluatePiles(const SweepOptions& options) {
  const auto needed = neededCells(options);
  if (!needed) return tl::make_unexpected(needed.error());
  EvaluationResult out;
  out.name = "bricks";
  std::vector<PileRun> runs;
  json all = json::array();
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    auto run = runPile(options.world, seed, options.calibrate, *needed);
    if (!run) return tl::make_unexpected(run.error());
    if (!run->refused.empty()) out.notes += fmt::format("seed {}: {}\n", seed, run->refused);
    all.push_back(toJson(*run, seed));
    runs.push_back(std::move(*run));
  }
  out.figures = figuresOf(runs);
  out.runs_json = all.dump();
  out.notes +=
      "a seed is one pile in the world: first look from the start, drive before what was found, "
      "the sweeps that were planned there, bricks; by the simulator's own sensors. Errors of "
      "bricks "
      "trusted above 0.7, against the truth.";
  return out;
}

}  // namespace kiln
