#include <nlohmann/json.hpp>

#include "common/core/atomic_file.h"
#include "common/core/clock.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/yard_calibration.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr double kDeg = M_PI / 180.0;

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
  void append(std::vector<Figure>& figures) const {
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

}  // namespace

Result<EvaluationResult> calibrateSensors(const SweepOptions& options) {
  auto robot = nominalRobot();
  if (!robot) return tl::make_unexpected(robot.error());

  EvaluationResult out;
  out.name = "calibrate";
  Errors lidar{"lidar", "X_flange_lidar"}, thermal{"thermal", "X_flange_thermal"},
      camera{"operator_camera", "X_base_operatorcamera"};
  std::vector<double> wall_s, simulated_s;
  json runs = json::array();
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    const SteadyClock clock;
    const Stamp begin = clock.now();
    auto done = calibrateInYard(seed);
    if (!done) return tl::make_unexpected(done.error());
    wall_s.push_back(toSeconds(clock.now() - begin));
    simulated_s.push_back(done->simulated_s);
    const json truth = json::parse(done->truth_json);
    json run{{"seed", seed}, {"report", done->found.report}};
    run["lidar"] =
        lidar.add(truth, robot->X_flange_lidar, done->found.lidar.flange_lidar.X_parent_sensor);
    run["thermal"] = thermal.add(truth, robot->X_flange_thermal,
                                 done->found.thermal.flange_thermal.X_parent_sensor);
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
  lidar.append(out.figures);
  thermal.append(out.figures);
  camera.append(out.figures);
  out.figures.push_back({"operator_camera_refused",
                         static_cast<double>(runs.size() - camera.after_m.size()), "", "", true});
  out.figures.push_back({"simulated_median_s", median(simulated_s), "s", "", true});
  out.figures.push_back({"wall_median_s", median(wall_s), "s", "", true});
  out.runs_json = runs.dump();
  if (!options.out.empty()) out.notes += "written to " + options.out;
  return out;
}

}  // namespace kiln
