#include "robot/evaluation/heat_accuracy.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "common/core/units.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr double kMaxRange_m = 1.0;
constexpr double kGross_m = 0.5;
constexpr double kMaxAxisAngle_rad = 10.0 * kDeg;

struct TruthSample {
  double t_s = 0.0;
  Eigen::Vector3d p_map_thermal;
  Eigen::Quaterniond q_map_thermal;
};

std::vector<TruthSample> parseTrace(const std::string& jsonl) {
  std::vector<TruthSample> out;
  std::istringstream lines(jsonl);
  for (std::string line; std::getline(lines, line);) {
    const json sample = json::parse(line, nullptr, false);
    if (sample.is_discarded() || !sample.contains("thermal")) continue;
    const auto& p = sample["thermal"]["xyz_m"];
    const auto& q = sample["thermal"]["wxyz"];
    out.push_back({sample["t"].get<double>(),
                   {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()},
                   Eigen::Quaterniond(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(),
                                      q[3].get<double>())});
  }
  return out;
}

/// True camera pose at a time, interpolated; false outside the trace.
bool cameraAt(const std::vector<TruthSample>& trace, double t_s, Eigen::Isometry3d& X_map_thermal) {
  const auto after =
      std::lower_bound(trace.begin(), trace.end(), t_s,
                       [](const TruthSample& sample, double t) { return sample.t_s < t; });
  if (after == trace.begin() || after == trace.end()) return false;
  const auto before = after - 1;
  const double s = (t_s - before->t_s) / std::max(1e-9, after->t_s - before->t_s);
  X_map_thermal = Eigen::Isometry3d::Identity();
  X_map_thermal.translation() = (1 - s) * before->p_map_thermal + s * after->p_map_thermal;
  X_map_thermal.linear() = before->q_map_thermal.slerp(s, after->q_map_thermal).toRotationMatrix();
  return true;
}

Eigen::Vector3d vector3(const json& xyz) {
  return {xyz[0].get<double>(), xyz[1].get<double>(), xyz[2].get<double>()};
}

/// True plate centre, in `thermal`, of the fire place that an estimate is nearest to.
std::optional<Eigen::Vector3d> nearestPlate(const json& places,
                                            const Eigen::Isometry3d& X_map_thermal,
                                            const Eigen::Vector3d& p_thermal) {
  std::optional<Eigen::Vector3d> nearest;
  for (const auto& place : places) {
    const Eigen::Vector3d plate = X_map_thermal.inverse() * vector3(place["plate_xyz_m"]);
    if (!nearest || (plate - p_thermal).norm() < (*nearest - p_thermal).norm()) nearest = plate;
  }
  return nearest;
}

}  // namespace

void appendHeatErrors(const MissionRun& run, HeatErrors& errors) {
  const json reports = json::parse(run.robot_json);
  const auto trace = parseTrace(run.trace_jsonl);
  for (const auto& estimate : reports["robot"].value("heat_estimates", json::array())) {
    Eigen::Isometry3d X_map_thermal;
    if (!cameraAt(trace, estimate["t"].get<double>(), X_map_thermal)) continue;
    const Eigen::Vector3d estimated = vector3(estimate["p_thermal"]);
    const auto truth = nearestPlate(reports["truth"].at("fire_places"), X_map_thermal, estimated);
    if (!truth) continue;
    if (!((estimated - *truth).norm() <= kGross_m)) {
      ++errors.gross;
      continue;
    }
    const double range = truth->norm();
    const bool near = range <= kMaxRange_m &&
                      std::acos(std::clamp(truth->z() / range, -1.0, 1.0)) <= kMaxAxisAngle_rad;
    if (!near) continue;
    errors.range_m.push_back(std::abs(estimated.norm() - range));
    errors.lateral_m.push_back(estimated.cross(truth->normalized()).norm());
    errors.baseline_range_m.push_back(std::abs(estimate["baseline_range_m"].get<double>() - range));
  }
}

}  // namespace kiln
