#include <nlohmann/json.hpp>

#include "robot/evaluation/child_process.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/map_command.h"
#include "robot/evaluation/mapping_drive.h"

namespace kiln {
namespace {

using nlohmann::json;

/// Of all seeds.
struct Sums {
  std::vector<double> position_m, yaw_deg, return_m, return_without_m, odometry_m;
  std::vector<double> loop_before_m, loop_m, overlap;
  double least_loops = 1e9;
  double largest_bytes = 0.0;
};

void append(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

Result<json> evaluateSeed(int seed, Sums& sums) {
  const ScratchFolder scratch("mapping");
  const auto drive = driveForMap(seed, scratch.path());
  if (!drive) return tl::make_unexpected(drive.error());
  MapCommandOptions options;
  options.recordings = {drive->recording};
  options.out = scratch.file("with.map");
  const auto with = makeMap(options);
  if (!with) return tl::make_unexpected(with.error());
  options.close_loops = false;
  options.out = scratch.file("without.map");
  const auto without = makeMap(options);
  if (!without) return tl::make_unexpected(without.error());

  const BaseTrace truth(drive->run.trace_jsonl);
  const KeyframeErrors errors = keyframeErrors(with->built, truth);
  const KeyframeErrors open = keyframeErrors(without->built, truth);
  const MapReport& report = with->built.report;
  const double odometry_m = odometryErrorAtReturn(drive->run).value_or(0.0);
  append(sums.position_m, errors.position_m);
  append(sums.yaw_deg, errors.yaw_deg);
  append(sums.return_m, errors.return_m);
  append(sums.return_without_m, open.return_m);
  sums.odometry_m.push_back(odometry_m);
  sums.loop_before_m.push_back(report.loop_before.rms_m);
  sums.loop_m.push_back(report.loop.rms_m);
  sums.overlap.push_back(report.overlap_median);
  sums.least_loops = std::min(sums.least_loops, static_cast<double>(report.loops));
  sums.largest_bytes = std::max(sums.largest_bytes, static_cast<double>(report.file_bytes));
  return json{{"seed", seed},
              {"loops", report.loops},
              {"loop_before_rms_m", report.loop_before.rms_m},
              {"loop_rms_m", report.loop.rms_m},
              {"position_median_m", median(errors.position_m)},
              {"return_median_m", median(errors.return_m)},
              {"return_without_loops_median_m", median(open.return_m)},
              {"odometry_at_return_m", odometry_m},
              {"overlap_median", report.overlap_median},
              {"file_bytes", report.file_bytes}};
}

}  // namespace

Result<EvaluationResult> evaluateMapping(const SweepOptions& options) {
  Sums sums;
  json runs = json::array();
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    auto run = evaluateSeed(seed, sums);
    if (!run) return tl::make_unexpected(run.error());
    fmt::print(stderr, "seed {:>3}: {}\n", seed, run->dump());
    runs.push_back(std::move(*run));
  }
  EvaluationResult out;
  out.name = "mapping";
  out.figures = {{"loops_min", sums.least_loops, "", "", true},
                 {"loop_before_rms_m", median(sums.loop_before_m), "m", "", true},
                 {"loop_rms_m", median(sums.loop_m), "m", "", true},
                 {"position_median_m", median(sums.position_m), "m", "", true},
                 {"position_p95_m", quantile(sums.position_m, 0.95), "m", "", true},
                 {"yaw_p95_deg", quantile(sums.yaw_deg, 0.95), "deg", "", true},
                 {"return_median_m", median(sums.return_m), "m", "", true},
                 {"return_without_loops_m", median(sums.return_without_m), "m", "", true},
                 {"odometry_at_return_m", median(sums.odometry_m), "m", "", true},
                 {"overlap_median", median(sums.overlap), "", "", true},
                 {"file_bytes_max", sums.largest_bytes, "", "", true}};
  out.runs_json = runs.dump();
  out.notes = fmt::format(
      "{} keyframes of {} drives against the world's truth; robots with nominal mountings.",
      sums.position_m.size(), runs.size());
  return out;
}

}  // namespace kiln
