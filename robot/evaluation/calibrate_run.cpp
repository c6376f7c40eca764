#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/atomic_file.h"
#include "common/core/clock.h"
#include "common/core/units.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/yard_calibration.h"

namespace kiln {
namespace {

using nlohmann::json;

Eigen::Isometry3d poseFrom(const json& j) {
  const auto& p = j.at("xyz_m");
  const auto& q = j.at("wxyz");
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(p[0], p[1], p[2]);
  X.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  return X;
}

/// Errors of one sensor before and after, over the seeds.
struct Errors {
  std::string sensor, key;
  std::vector<double> before_m{}, before_deg{}, after_m{}, after_deg{};

  json add(const json& truth, const PoseConfig& nominal, const Eigen::Isometry3d& found) {
    const Eigen::Isometry3d X_true = poseFrom(truth.at("perturbations").at(key));
    const ExtrinsicDifference before = difference(X_true, nominal.pose()),
                              after = difference(X_true, found);
    before_m.push_back(before.translation_m);
    before_deg.push_back(before.rotation_rad / kDeg);
    after_m.push_back(after.translation_m);
    after_deg.push_back(after.rotation_rad / kDeg);
    return {{"before_mm", 1e3 * before_m.back()},
            {"before_deg", before_deg.back()},
            {"after_mm", 1e3 * after_m.back()},
            {"after_deg", after_deg.back()}};
  }
  void append(std::vector<Metric>& figures) const {
    figures.push_back(
        {sensor + "_position_before_median_mm", 1e3 * median(before_m), "mm", "", true});
    figures.push_back({sensor + "_position_median_mm", 1e3 * median(after_m), "mm", "", true});
    figures.push_back({sensor + "_position_max_mm", 1e3 * quantile(after_m, 1.0), "mm", "", true});
    figures.push_back(
        {sensor + "_rotation_before_median_deg", median(before_deg), "deg", "", true});
    figures.push_back({sensor + "_rotation_median_deg", median(after_deg), "deg", "", true});
    figures.push_back({sensor + "_rotation_max_deg", quantile(after_deg, 1.0), "deg", "", true});
  }
};

/// Of the nozzle, what matters to a jet: where it leaves and in which direction; a turn about the
/// jet changes nothing.
struct JetErrors {
  std::vector<double> before_deg{}, after_deg{}, before_mm{}, after_mm{}, before_hit_mm{},
      after_hit_mm{}, flow_percent{};

  json add(const json& truth, const PoseConfig& nominal, const NozzleCalibration& found) {
    const json& drawn = truth.at("perturbations");
    const Eigen::Isometry3d X_true = poseFrom(drawn.at("X_flange_nozzle"));
    const json& flow_lpm = drawn.at("pump_full_flow_lpm");
    const double flow = (flow_lpm[0].get<double>() + flow_lpm[1].get<double>()) /
                        (2.0 * PumpController::Config{}.flow_lpm);
    flow_percent.push_back(1e2 * std::abs(found.flow - flow));
    const auto note = [&](const Eigen::Isometry3d& X, std::vector<double>& deg,
                          std::vector<double>& mm, std::vector<double>& hit_mm) {
      constexpr double kStandoff_m = 0.8;
      const Eigen::Isometry3d off = X_true.inverse() * X;
      const Eigen::Vector3d axis = off.linear().col(0), p = off.translation();
      deg.push_back(std::atan2(axis.tail<2>().norm(), axis.x()) / kDeg);
      mm.push_back(1e3 * p.tail<2>().norm());
      hit_mm.push_back(1e3 * (p + kStandoff_m * axis).tail<2>().norm());
    };
    note(nominal.pose(), before_deg, before_mm, before_hit_mm);
    note(found.flange_nozzle.X_parent_sensor, after_deg, after_mm, after_hit_mm);
    return {{"direction_before_deg", before_deg.back()},
            {"direction_after_deg", after_deg.back()},
            {"lateral_before_mm", before_mm.back()},
            {"lateral_after_mm", after_mm.back()},
            {"at_0.8_m_before_mm", before_hit_mm.back()},
            {"at_0.8_m_after_mm", after_hit_mm.back()},
            {"flow_true", flow},
            {"flow_found", found.flow}};
  }
  void append(std::vector<Metric>& figures) const {
    const auto rows = [&](const std::string& what, const char* unit, const auto& before,
                          const auto& after) {
      figures.push_back({what + "_before_median_" + unit, median(before), unit, "", true});
      figures.push_back({what + "_median_" + unit, median(after), unit, "", true});
      figures.push_back({what + "_max_" + unit, quantile(after, 1.0), unit, "", true});
    };
    rows("nozzle_direction", "deg", before_deg, after_deg);
    rows("nozzle_lateral", "mm", before_mm, after_mm);
    rows("nozzle_at_0.8_m", "mm", before_hit_mm, after_hit_mm);
    figures.push_back({"pump_flow_off_median_percent", median(flow_percent), "%", "", true});
  }
};

}  // namespace

Result<EvaluationResult> calibrateSensors(const SweepOptions& options) {
  const auto yard = yardOf(options.world);
  if (!yard) return tl::make_unexpected(yard.error());
  auto robot = loadResource<RobotGeometry>(yard->robot);
  if (!robot) return tl::make_unexpected(robot.error());

  EvaluationResult out;
  out.name = "calibrate";
  Errors lidar{"lidar", "X_flange_lidar"}, thermal{"thermal", "X_flange_thermal"},
      camera{"operator_camera", "X_base_operatorcamera"};
  JetErrors nozzle;
  std::vector<double> wall_s, simulated_s;
  json runs = json::array();
  double collisions_total = 0.0;
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    const SteadyClock clock;
    const Stamp begin = clock.now();
    auto done = calibrateInYard(*yard, seed);
    if (!done) return tl::make_unexpected(done.error());
    wall_s.push_back(toSeconds(clock.now() - begin));
    simulated_s.push_back(done->simulated_s);
    const json truth = json::parse(done->truth_json);
    const json collisions = truth.value("collisions", json::array());
    collisions_total += static_cast<double>(collisions.size());
    json run{{"seed", seed}, {"report", done->found.report}, {"collisions", collisions}};
    run["lidar"] =
        lidar.add(truth, robot->X_flange_lidar, done->found.lidar.flange_lidar.X_parent_sensor);
    if (done->found.thermal)
      run["thermal"] = thermal.add(truth, robot->X_flange_thermal,
                                   done->found.thermal->flange_thermal.X_parent_sensor);
    if (done->found.nozzle)
      run["nozzle"] = nozzle.add(truth, robot->X_flange_nozzle, *done->found.nozzle);
    if (done->found.operator_camera)
      run["operator_camera"] = camera.add(truth, robot->X_base_operatorcamera,
                                          done->found.operator_camera->X_parent_sensor);
    runs.push_back(run);
    for (const std::string& line : done->found.report)
      out.notes += fmt::format("seed {}: {}\n", seed, line);
    if (options.out.empty()) continue;
    const std::string text = calibrationFile(*done, seed);
    if (auto written = writeFileAtomically(options.out, text); !written)
      return tl::make_unexpected(written.error());
  }
  const auto refused = [&](const char* what, std::size_t found) {
    out.figures.push_back({what, static_cast<double>(runs.size() - found), "", "", true});
  };
  lidar.append(out.figures);
  if (!thermal.after_m.empty()) {  // else the robot has neither camera nor nozzle
    thermal.append(out.figures);
    nozzle.append(out.figures);
    camera.append(out.figures);
    refused("nozzle_refused", nozzle.after_mm.size());
    refused("operator_camera_refused", camera.after_m.size());
  }
  out.figures.push_back({"collisions_total", collisions_total, "", "", true});
  out.figures.push_back({"simulated_median_s", median(simulated_s), "s", "", true});
  out.figures.push_back({"wall_median_s", median(wall_s), "s", "", true});
  out.runs_json = runs.dump();
  if (!options.out.empty()) out.notes += "written to " + options.out;
  return out;
}

}  // namespace kiln
