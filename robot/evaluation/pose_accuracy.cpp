#include "robot/evaluation/pose_accuracy.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/evaluation/base_trace.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr double kNear_m = 0.5;
constexpr double kRest_m = 0.002;  ///< between two samples

Pose2 poseAt(const json& row, std::size_t first) {
  return {row[first].get<double>(), row[first + 1].get<double>(), row[first + 2].get<double>()};
}

double apart(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

bool nearWorkPose(const Pose2& X, const PosePlaces& places) {
  return std::any_of(places.work_poses.begin(), places.work_poses.end(), [&](const auto& p) {
    return std::hypot(X.x_m - p.first, X.y_m - p.second) < kNear_m;
  });
}

}  // namespace

std::vector<PoseSample> poseSamples(const MissionRun& run) {
  const json reports = json::parse(run.robot_json);
  const BaseTrace trace(run.trace_jsonl);
  std::vector<PoseSample> out;
  for (const json& row : reports["robot"].value("track", json::array())) {
    const double t_s = row[0].get<double>();
    const auto truth = trace.at(t_s);
    if (!truth) continue;
    PoseSample sample;
    sample.t_s = t_s;
    sample.truth = *truth;
    sample.believed = poseAt(row, 1);
    sample.odometry = poseAt(row, 4);
    sample.located = row[7].get<int>() == 1;
    sample.resets = row[9].get<int>();
    sample.position_m = apart(sample.believed, *truth);
    sample.yaw_deg = std::abs(wrapAngle(sample.believed.yaw_rad - truth->yaw_rad)) / kDeg;
    out.push_back(sample);
  }
  return out;
}

void appendPoseErrors(const MissionRun& run, const PosePlaces& places, PoseErrors& errors) {
  bool located = false;
  int resets = -1;
  Pose2 X_map_odom, before;
  for (const PoseSample& sample : poseSamples(run)) {
    const Pose2& truth = sample.truth;
    if (sample.resets != resets) {  // put down anew: odometry starts from the nominal pose
      resets = sample.resets;
      located = false;
      X_map_odom = inverse(sample.odometry);
    }
    if (located && !sample.located) ++errors.lost;
    located = sample.located;
    if (!located) continue;
    const double odometry_m = apart(X_map_odom * sample.odometry, truth);
    errors.position_m.push_back(sample.position_m);
    errors.yaw_deg.push_back(sample.yaw_deg);
    errors.odometry_m.push_back(odometry_m);
    if (std::abs(truth.x_m - places.doorway_x_m) < kNear_m) {
      errors.doorway_m.push_back(sample.position_m);
      errors.doorway_deg.push_back(sample.yaw_deg);
      errors.odometry_doorway_m.push_back(odometry_m);
    }
    if (apart(truth, before) < kRest_m && nearWorkPose(truth, places)) {
      errors.fire_m.push_back(sample.position_m);
      errors.fire_deg.push_back(sample.yaw_deg);
    }
    before = truth;
  }
}

}  // namespace kiln
