#include "robot/evaluation/pose_accuracy.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "common/geom/pose.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr double kNear_m = 0.5;
constexpr double kRest_m = 0.002;  ///< between two samples
constexpr double kDeg = M_PI / 180.0;

struct TruthSample {
  double t_s = 0.0;
  Pose2 X_map_base;
};

std::vector<TruthSample> parseBaseTrace(const std::string& jsonl) {
  std::vector<TruthSample> out;
  std::istringstream lines(jsonl);
  for (std::string line; std::getline(lines, line);) {
    const json sample = json::parse(line, nullptr, false);
    if (sample.is_discarded() || !sample.contains("base")) continue;
    const auto& p = sample["base"]["xyz_m"];
    const auto& q = sample["base"]["wxyz"];
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = Eigen::Vector3d(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    X.linear() = Eigen::Quaterniond(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(),
                                    q[3].get<double>())
                     .toRotationMatrix();
    out.push_back({sample["t"].get<double>(), projectToGround(X)});
  }
  return out;
}

std::optional<Pose2> trueAt(const std::vector<TruthSample>& trace, double t_s) {
  const auto after =
      std::lower_bound(trace.begin(), trace.end(), t_s,
                       [](const TruthSample& sample, double t) { return sample.t_s < t; });
  if (after == trace.begin() || after == trace.end()) return std::nullopt;
  const TruthSample& a = *(after - 1);
  const double s = (t_s - a.t_s) / std::max(1e-9, after->t_s - a.t_s);
  const Pose2 &p = a.X_map_base, &q = after->X_map_base;
  return Pose2{p.x_m + s * (q.x_m - p.x_m), p.y_m + s * (q.y_m - p.y_m),
               wrapAngle(p.yaw_rad + s * wrapAngle(q.yaw_rad - p.yaw_rad))};
}

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

void appendPoseErrors(const MissionRun& run, const PosePlaces& places, PoseErrors& errors) {
  const json reports = json::parse(run.robot_json);
  const auto trace = parseBaseTrace(run.trace_jsonl);
  bool located = false;
  int resets = -1;
  Pose2 X_map_odom, before;
  for (const json& row : reports["robot"].value("track", json::array())) {
    const double t_s = row[0].get<double>();
    const auto truth = trueAt(trace, t_s);
    if (!truth) continue;
    const Pose2 believed = poseAt(row, 1), odometry = poseAt(row, 4);
    if (row[9].get<int>() != resets) {  // put down anew: odometry starts from the nominal pose
      resets = row[9].get<int>();
      located = false;
      X_map_odom = inverse(odometry);
    }
    const bool now_located = row[7].get<int>() == 1;
    if (located && !now_located) ++errors.lost;
    located = now_located;
    if (!located) continue;
    const double position_m = apart(believed, *truth);
    const double yaw_deg = std::abs(wrapAngle(believed.yaw_rad - truth->yaw_rad)) / kDeg;
    const double odometry_m = apart(X_map_odom * odometry, *truth);
    errors.position_m.push_back(position_m);
    errors.yaw_deg.push_back(yaw_deg);
    errors.odometry_m.push_back(odometry_m);
    if (std::abs(truth->x_m - places.doorway_x_m) < kNear_m) {
      errors.doorway_m.push_back(position_m);
      errors.doorway_deg.push_back(yaw_deg);
      errors.odometry_doorway_m.push_back(odometry_m);
    }
    if (apart(*truth, before) < kRest_m && nearWorkPose(*truth, places)) {
      errors.fire_m.push_back(position_m);
      errors.fire_deg.push_back(yaw_deg);
    }
    before = *truth;
  }
}

}  // namespace kiln
