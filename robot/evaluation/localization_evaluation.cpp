#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/mission_sweep.h"
#include "robot/evaluation/pose_accuracy.h"
#include "robot/scene/fire_site_map.h"

namespace kiln {
namespace {

using nlohmann::json;

Result<PosePlaces> nominalPlaces() {
  const auto arena = loadResource<ArenaMap>("config/arena_kitchen.yaml");
  if (!arena) return tl::make_unexpected(arena.error());
  PosePlaces places;
  places.doorway_x_m = arena->doorway.pose().x_m;
  const auto site = loadFireSite(*arena);
  if (!site) return tl::make_unexpected(site.error());
  for (const FirePlaceConfig& fire : site->places)
    places.work_poses.emplace_back(fire.work_pose.pose().x_m, fire.work_pose.pose().y_m);
  return places;
}

json describeRun(const SeedResult& result, const PosePlaces& places) {
  if (!result.run)
    return {{"seed", result.seed}, {"outcome", "error"}, {"reason", result.run.error().message}};
  PoseErrors errors;
  appendPoseErrors(*result.run, places, errors);
  return {{"seed", result.seed},
          {"outcome", result.run->success ? "success" : "failed"},
          {"position_median_m", median(errors.position_m)},
          {"position_max_m", quantile(errors.position_m, 1.0)},
          {"yaw_max_deg", quantile(errors.yaw_deg, 1.0)},
          {"odometry_max_m", quantile(errors.odometry_m, 1.0)},
          {"lost", errors.lost}};
}

}  // namespace

Result<EvaluationResult> evaluateLocalization(const SweepOptions& options) {
  const auto places = nominalPlaces();
  if (!places) return tl::make_unexpected(places.error());
  PoseErrors errors;
  std::vector<double> scan_ms;
  json runs = json::array();
  for (const SeedResult& result : runSeeds(options)) {
    runs.push_back(describeRun(result, *places));
    if (!result.run) continue;
    appendPoseErrors(*result.run, *places, errors);
    for (const double s : result.run->locate_s) scan_ms.push_back(1e3 * s);
  }
  EvaluationResult out;
  out.name = "localization";
  out.figures = {
      {"position_median_m", median(errors.position_m), "m", "", true},
      {"position_p95_m", quantile(errors.position_m, 0.95), "m", "", true},
      {"yaw_p95_deg", quantile(errors.yaw_deg, 0.95), "deg", "", true},
      {"lost_total", static_cast<double>(errors.lost), "", "", true},
      {"doorway_p95_m", quantile(errors.doorway_m, 0.95), "m", "", true},
      {"doorway_p95_deg", quantile(errors.doorway_deg, 0.95), "deg", "", true},
      {"fire_p95_m", quantile(errors.fire_m, 0.95), "m", "", true},
      {"fire_p95_deg", quantile(errors.fire_deg, 0.95), "deg", "", true},
      {"scan_median_ms", median(scan_ms), "ms", "", true},
      {"scan_p99_ms", quantile(scan_ms, 0.99), "ms", "", true},
      {"odometry_alone_median_m", median(errors.odometry_m), "m", "", true},
      {"odometry_alone_p95_m", quantile(errors.odometry_m, 0.95), "m", "", true},
      {"odometry_alone_doorway_p95_m", quantile(errors.odometry_doorway_m, 0.95), "m", "", true},
  };
  out.runs_json = runs.dump();
  out.notes = fmt::format(
      "{} poses of {} missions of {} robots against the world's truth, 5 a second; odometry alone "
      "= the same "
      "wheels from the nominal start pose.",
      errors.position_m.size(), runs.size(), options.calibrate ? "calibrated" : "uncalibrated");
  return out;
}

}  // namespace kiln
