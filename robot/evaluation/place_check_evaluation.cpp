#include <cmath>
#include <random>

#include <nlohmann/json.hpp>

#include "common/core/atomic_file.h"
#include "common/geom/pose.h"
#include "robot/evaluation/child_process.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/mission_run.h"

namespace kiln {
namespace {

using nlohmann::json;

// Only the first place is of interest: the mission ends soon after it was looked at.
constexpr const char* kShortMission =
    "fire:\n  check:\n    wait_s: 0.5\n  clock:\n    limit_s: 75\n    park_limit_s: 1\n";
constexpr double kLeast_m = 0.15, kMost_m = 0.40;

struct Checked {
  json last;             ///< newest check of the first place
  double error_m = NAN;  ///< sensed against true place
  double true_offset_m = 0.0;
  int collisions = 0;
};

/// One mission up to the first place. @param misplaced_m  0: as the seed draws it.
Result<Checked> runTo(int seed, double misplaced_m, const std::string& config) {
  MissionRunOptions options;
  options.seed = seed;
  options.robot_args = {"--config", config};
  if (misplaced_m > 0.0)
    options.world_args = {"--fault", fmt::format("fire_box_misplaced={:.3f},1@0", misplaced_m)};
  auto run = runMission(options);
  if (!run) return tl::make_unexpected(run.error());
  const json both = json::parse(run->robot_json);
  const json& truth = both.at("truth");
  Checked out;
  out.collisions = static_cast<int>(truth.at("collisions").size());
  const json& place = truth.at("fire_places").at(0);
  for (const json& check : both.at("robot").at("place_checks"))
    if (check.at("place") == place.at("name")) out.last = check;
  if (out.last.is_null())
    return makeError(ErrorCode::NotFound, "seed {}: the mission never looked at {}: {}", seed,
                     place.at("name").get<std::string>(),
                     both.at("robot").value("reason", std::string()));
  if (out.last.contains("sensed")) {
    const auto& opening = place.at("opening").at("xyz_m");
    out.error_m = std::hypot(out.last["sensed"][0].get<double>() - opening[0].get<double>(),
                             out.last["sensed"][1].get<double>() - opening[1].get<double>());
  }
  return out;
}

}  // namespace

Result<EvaluationResult> evaluatePlaceCheck(const SweepOptions& options) {
  const ScratchFolder scratch("place-check");
  const std::string config = scratch.file("robot.yaml");
  if (auto written = writeFileAtomically(config, kShortMission); !written)
    return tl::make_unexpected(written.error());
  json runs = json::array();
  std::vector<double> errors_m;
  double misplaced = 0, refused = 0, normal = 0, refused_falsely = 0, collisions = 0, unchecked = 0;
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const double distance_m = std::uniform_real_distribution<double>(kLeast_m, kMost_m)(random);
    for (const double off_m : {0.0, distance_m}) {
      const auto checked = runTo(seed, off_m, config);
      if (!checked) {  // the other seeds still say something
        fmt::print(stderr, "seed {:>3}: {}\n", seed, checked.error().message);
        runs.push_back(
            {{"seed", seed}, {"misplaced_m", off_m}, {"error", checked.error().message}});
        ++unchecked;
        continue;
      }
      const bool fits = checked->last.at("verdict") == "fits";
      (off_m > 0.0 ? misplaced : normal) += 1;
      refused += off_m > 0.0 && !fits ? 1 : 0;
      refused_falsely += off_m == 0.0 && !fits ? 1 : 0;
      collisions += checked->collisions;
      if (std::isfinite(checked->error_m)) errors_m.push_back(checked->error_m);
      runs.push_back({{"seed", seed},
                      {"misplaced_m", off_m},
                      {"check", checked->last},
                      {"error_m", checked->error_m},
                      {"collisions", checked->collisions}});
    }
  }
  EvaluationResult out;
  out.name = "place-check";
  out.figures = {{"misplaced", misplaced, "", "", true},
                 {"not_refused", misplaced - refused, "", "", true},
                 {"normal", normal, "", "", true},
                 {"refused_falsely", refused_falsely, "", "", true},
                 {"unchecked", unchecked, "", "", true},
                 {"position_median_m", median(errors_m), "m", "", true},
                 {"position_p95_m", quantile(errors_m, 0.95), "m", "", true},
                 {"position_max_m", quantile(errors_m, 1.0), "m", "", true},
                 {"collisions_total", collisions, "", "", true}};
  out.runs_json = runs.dump();
  out.notes = "Missions up to the first place; misplaced by 15 to 40 cm in a direction by seed.";
  return out;
}

}  // namespace kiln
