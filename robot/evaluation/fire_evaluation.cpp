#include <algorithm>

#include <nlohmann/json.hpp>

#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/heat_accuracy.h"
#include "robot/evaluation/mission_sweep.h"
#include "robot/evaluation/truth.h"

namespace kiln {
namespace {

using nlohmann::json;

json describeRun(const SeedResult& result) {
  if (!result.run)
    return {{"seed", result.seed}, {"outcome", "error"}, {"reason", result.run.error().message}};
  json run = json::parse(result.run->report_json);
  run.erase("states");
  run["real_time_factor"] = result.run->realTimeFactor();
  return run;
}

}  // namespace

std::string judgeFire(const json& robot, const json& truth, json& report) {
  report["litres_delivered"] = truth.at("litres_delivered");
  report["burning_place"] = truth.value("burning_name", "");
  report["litres_est"] = robot.value("litres_est", 0.0);
  return burningLitres(truth) >= 1.0 ? "" : "not extinguished";
}

Result<EvaluationResult> evaluateFire(const SweepOptions& options) {
  const std::vector<SeedResult> results = runSeeds(options);
  HeatErrors heat;
  json runs = json::array();
  std::vector<double> mission_s, real_time_factor, litres;
  double successes = 0, collisions = 0;
  for (const SeedResult& result : results) {
    runs.push_back(describeRun(result));
    if (!result.run) continue;
    appendHeatErrors(*result.run, heat);
    const json report = json::parse(result.run->report_json);
    successes += result.run->success ? 1 : 0;
    collisions += static_cast<double>(report.at("collisions").size());
    mission_s.push_back(report.at("simulated_s").get<double>());
    real_time_factor.push_back(result.run->realTimeFactor());
    double best = 0.0;
    for (const auto& l : report.at("litres_delivered")) best = std::max(best, l.get<double>());
    litres.push_back(best);
  }
  EvaluationResult out;
  out.name = "fire";
  const bool flat = isFlat(options.world);
  if (flat) out.goal_set = "fire_flat";
  out.figures = {
      {"success_rate", successes / std::max<double>(1, static_cast<double>(results.size())), "", "",
       true},
      {"collisions_total", collisions, "", "", true},
      {"mission_median_s", median(mission_s), "s", "", true},
      {"mission_max_s", quantile(mission_s, 1.0), "s", "", true},
      {"heat_range_median_m", median(heat.range_m), "m", "", true},
      {"heat_range_p95_m", quantile(heat.range_m, 0.95), "m", "", true},
      {"heat_lateral_median_m", median(heat.lateral_m), "m", "", true},
      {"heat_lateral_p95_m", quantile(heat.lateral_m, 0.95), "m", "", true},
      {"heat_gross", static_cast<double>(heat.gross), "", "", true},
      {"baseline_range_median_m", median(heat.baseline_range_m), "m", "", true},
      {"baseline_range_p95_m", quantile(heat.baseline_range_m, 0.95), "m", "", true},
      {"litres_median", median(litres), "l", "", true},
      {"litres_min", quantile(litres, 0.0), "l", "", true},
      {"real_time_factor", median(real_time_factor), "", "", true},
  };
  out.runs_json = runs.dump();
  out.notes = fmt::format(
      "{} world, {} seeds, {}, {} at a time; {} heat estimates within 1.0 m and 10 deg. baseline = "
      "the "
      "paper's "
      "bounding-box distance on the same frames.",
      flat ? "flat" : "full", results.size(), options.calibrate ? "calibrated" : "not calibrated",
      std::max(1, options.jobs), heat.range_m.size());
  return out;
}

}  // namespace kiln
