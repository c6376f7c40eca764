#include <csignal>
#include <fstream>

#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/atomic_file.h"
#include "robot/evaluation/calibration_routine.h"
#include "robot/evaluation/child_process.h"
#include "robot/evaluation/evaluation.h"
#include "robot/sim_link/sim_link.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr Duration kStep = std::chrono::milliseconds(8);
constexpr double kDeg = M_PI / 180.0;

template <class T>
Result<T> loadResource(const std::string& resource) {
  T config;
  auto file = resourcePath(resource);
  if (!file) return tl::make_unexpected(file.error());
  if (auto loaded = loadConfig(*file, config); !loaded) return tl::make_unexpected(loaded.error());
  return config;
}

/// The routine on the devices of a fresh world; the world's truth afterwards.
struct Calibrated {
  CalibrationResult found;
  json truth;
};

Result<Calibrated> calibrateIn(int seed, const RobotGeometry& robot, const ArenaMap& yard) {
  const ScratchFolder scratch("calibrate");
  const std::string endpoint = "ipc://" + scratch.file("world");
  auto world = ChildProcess::start(
      {siblingProgram("kiln-sim"), "--lockstep", "--world", "calibration", "--seed",
       std::to_string(seed), "--listen", endpoint, "--truth", scratch.file("truth.json")},
      scratch.file("sim.log"));
  if (!world) return tl::make_unexpected(world.error());
  auto found = [&]() -> Result<CalibrationResult> {
    ManualClock clock;
    SimLink::Config config;
    config.endpoint = endpoint;
    config.lockstep = true;
    config.version = KILN_VERSION;
    auto link = SimLink::connect(config, clock);
    if (!link) return tl::make_unexpected(link.error());
    clock.advanceTo((*link)->world().now);
    const auto step = [&]() -> Result<void> {
      clock.advanceBy(kStep);
      return (*link)->advanceTo(clock.now());
    };
    CalibrationRoutine routine({}, robot, yard,
                               {(*link)->arm(), (*link)->lidar(), (*link)->thermalCamera(),
                                (*link)->operatorCamera(), clock, step});
    return routine.run();
  }();  // says bye
  if (!found) return tl::make_unexpected(found.error());
  world->signal(SIGTERM);
  (void)world->wait(std::chrono::seconds(5));
  std::ifstream in(scratch.file("truth.json"));
  json truth = json::parse(in, nullptr, false);
  if (truth.is_discarded() || !truth.contains("perturbations")) {
    return makeError(ErrorCode::NotFound, "kiln-sim left no truth; its last words:\n{}",
                     tailOf(scratch.file("sim.log"), 6));
  }
  return Calibrated{std::move(*found), std::move(truth)};
}

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
  auto robot = loadResource<RobotGeometry>("robot_model/bob.yaml");
  if (!robot) return tl::make_unexpected(robot.error());
  auto yard = loadResource<ArenaMap>("config/arena_calibration.yaml");
  if (!yard) return tl::make_unexpected(yard.error());

  EvaluationResult out;
  out.name = "calibrate";
  Errors lidar{"lidar", "X_flange_lidar"}, thermal{"thermal", "X_flange_thermal"},
      camera{"operator_camera", "X_base_operatorcamera"};
  json runs = json::array();
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    auto done = calibrateIn(seed, *robot, *yard);
    if (!done) return tl::make_unexpected(done.error());
    json run{{"seed", seed}, {"report", done->found.report}};
    run["lidar"] = lidar.add(done->truth, robot->X_flange_lidar,
                             done->found.lidar.flange_lidar.X_parent_sensor);
    run["thermal"] = thermal.add(done->truth, robot->X_flange_thermal,
                                 done->found.thermal.flange_thermal.X_parent_sensor);
    if (done->found.operator_camera)
      run["operator_camera"] = camera.add(done->truth, robot->X_base_operatorcamera,
                                          done->found.operator_camera->X_parent_sensor);
    runs.push_back(run);
    for (const std::string& line : done->found.report)
      out.notes += fmt::format("seed {}: {}\n", seed, line);
    if (options.out.empty()) continue;
    RobotCalibration calibration = done->found.calibration;
    calibration.note = fmt::format("seed {} of the calibration yard", seed);
    for (const std::string& line : done->found.report) calibration.note += "; " + line;
    const std::string text =
        "# Mounting of the sensors as `kiln-eval calibrate` found it; for kiln-robotd "
        "--calibration.\n" +
        dumpConfig(calibration);
    if (auto written = writeFileAtomically(options.out, text); !written)
      return tl::make_unexpected(written.error());
  }
  lidar.append(out.figures);
  thermal.append(out.figures);
  camera.append(out.figures);
  out.runs_json = runs.dump();
  if (!options.out.empty()) out.notes += "written to " + options.out;
  return out;
}

}  // namespace kiln
