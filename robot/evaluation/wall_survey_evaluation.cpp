#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/mission_sweep.h"

// The wall mission's survey: pile and marker as the robot found them, against the world. Seen from
// where the robot truly began, which it does not know: what the odometry drifts is in it.
namespace kiln {
namespace {

using nlohmann::json;

/// Farther off it is something else that was found.
constexpr double kWrong_m = 0.5;
constexpr double kTrusted = 0.7;  // confidence of a brick that may be gripped

struct Off {
  double position_m = 0.0, yaw_deg = 0.0;
};

Pose2 poseOf(const json& frame) {
  return {frame.at("x_m").get<double>(), frame.at("y_m").get<double>(),
          frame.at("yaw_rad").get<double>()};
}

/// The marker's pose in the world's report: xyz and quaternion.
Pose2 poseOf3d(const json& frame) {
  const auto& p = frame.at("xyz_m");
  const auto& q = frame.at("wxyz");
  const double w = q.at(0), x = q.at(1), y = q.at(2), z = q.at(3);
  return {p.at(0).get<double>(), p.at(1).get<double>(),
          std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))};
}

Off between(const Pose2& truth, const Pose2& found) {
  return {std::hypot(found.x_m - truth.x_m, found.y_m - truth.y_m),
          std::abs(wrapAngle(found.yaw_rad - truth.yaw_rad)) / kDeg};
}

/// Of each trusted brick: how far it is from where it was found, m. Bricks stand in the layout's
/// order on both sides.
std::vector<double> bricksOff(const json& robot, const json& wall, const Pose2& X_true_map) {
  std::vector<double> out;
  const auto point = [](const json& p) { return Eigen::Vector3d(p.at(0), p.at(1), p.at(2)); };
  for (std::size_t i = 0; i < robot.at("bricks").size(); ++i) {
    const json& brick = robot.at("bricks").at(i);
    if (brick.at("confidence").get<double>() <= kTrusted) continue;
    const Eigen::Vector3d found = toIsometry(X_true_map) * point(brick.at("xyz_m"));
    out.push_back((found - point(wall.at("bricks").at(i).at("pose").at("xyz_m"))).norm());
  }
  return out;
}

json toJson(const Off& off) { return {{"position_m", off.position_m}, {"yaw_deg", off.yaw_deg}}; }

}  // namespace

std::string judgeWall(const json& robot, const json& truth, json& report) {
  if (robot.at("pile").is_null() || robot.at("wall").is_null()) return "not surveyed";
  const json& wall = truth.at("wall");
  const Pose2 X_true_map = poseOf(truth.at("start")) * inverse(poseOf(robot.at("map_start")));
  const Off pile = between(poseOf(wall.at("pile")), X_true_map * poseOf(robot.at("pile")));
  const Off marker = between(poseOf3d(wall.at("marker")), X_true_map * poseOf(robot.at("wall")));
  report["pile_off"] = toJson(pile);
  report["marker_off"] = toJson(marker);
  report["bricks_off_m"] = bricksOff(robot, wall, X_true_map);
  int stored = 0;
  for (const json& brick : wall.at("bricks")) stored += brick.contains("bin") ? 1 : 0;
  report["stored"] = robot.at("stored");
  report["stored_truly"] = stored;
  report["built"] = robot.at("built");
  report["placed"] = wall.at("placed");
  report["points"] = wall.at("points");
  report["falls"] = wall.at("falls");
  if (wall.at("falls").get<int>() > 0) return "bricks fell";
  if (pile.position_m > kWrong_m) return "wrong pile";
  if (marker.position_m > kWrong_m) return "wrong marker";
  return robot.at("built") == wall.at("placed") ? "" : "placed wrongly";
}

Result<EvaluationResult> evaluateWallSurvey(const SweepOptions& options) {
  const std::vector<SeedResult> results =
      runSeeds(options, "wall", {"--set", "wall.loading.bricks=0"});
  json runs = json::array();
  std::vector<double> bricks_m, pile_m, pile_deg, marker_m, marker_deg, mission_s, real_time_factor;
  double successes = 0, collisions = 0;
  for (const SeedResult& result : results) {
    if (!result.run) {
      runs.push_back(
          {{"seed", result.seed}, {"outcome", "error"}, {"reason", result.run.error().message}});
      continue;
    }
    json report = json::parse(result.run->report_json);
    successes += result.run->success ? 1 : 0;
    collisions += static_cast<double>(report.at("collisions").size());
    mission_s.push_back(report.at("simulated_s").get<double>());
    real_time_factor.push_back(result.run->realTimeFactor());
    if (report.contains("pile_off")) {
      for (const json& off : report["bricks_off_m"]) bricks_m.push_back(off.get<double>());
      pile_m.push_back(report["pile_off"]["position_m"]);
      pile_deg.push_back(report["pile_off"]["yaw_deg"]);
      marker_m.push_back(report["marker_off"]["position_m"]);
      marker_deg.push_back(report["marker_off"]["yaw_deg"]);
    }
    report.erase("states");
    runs.push_back(std::move(report));
  }
  EvaluationResult out;
  out.name = "wall-survey";
  out.figures = {
      {"success_rate", successes / std::max<double>(1, static_cast<double>(results.size())), "", "",
       true},
      {"collisions_total", collisions, "", "", true},
      {"pile_position_median_m", median(pile_m), "m", "", true},
      {"pile_position_max_m", quantile(pile_m, 1.0), "m", "", true},
      {"pile_yaw_max_deg", quantile(pile_deg, 1.0), "deg", "", true},
      {"bricks_trusted", static_cast<double>(bricks_m.size()), "", "", true},
      {"bricks_position_median_m", median(bricks_m), "m", "", true},
      {"bricks_position_max_m", quantile(bricks_m, 1.0), "m", "", true},
      {"marker_position_median_m", median(marker_m), "m", "", true},
      {"marker_position_max_m", quantile(marker_m, 1.0), "m", "", true},
      {"marker_yaw_max_deg", quantile(marker_deg, 1.0), "deg", "", true},
      {"mission_median_s", median(mission_s), "s", "", true},
      {"real_time_factor", median(real_time_factor), "", "", true},
  };
  out.runs_json = runs.dump();
  out.notes = fmt::format("{} seeds, wheel odometry alone.", results.size());
  return out;
}

}  // namespace kiln
