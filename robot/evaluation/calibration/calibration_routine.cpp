#include "robot/evaluation/calibration/calibration_routine.h"

#include <cmath>
#include <utility>

#include "common/core/log.h"
#include "common/core/units.h"
#include "robot/evaluation/calibration/camera_part.h"
#include "robot/evaluation/calibration/lidar_part.h"

namespace kiln {
namespace {

/// @param first_axis  of the part, from which on its errors are seen: 1 for a nozzle, of which
/// neither the turn about the jet nor the place along it matters.
std::string line(const char* what, const Extrinsics& found, const PoseConfig& nominal,
                 int first_axis = 0) {
  const ExtrinsicDifference off = difference(nominal.pose(), found.X_parent_sensor);
  const bool metres = found.unit == "m";
  return fmt::format(
      "{}: {:.1f} mm and {:.2f} deg off nominal; residuals {:.2f} -> {:.2f} {} rms over {} "
      "measurements from {} views; 1 sigma {:.1f} mm, {:.3f} deg",
      what, 1e3 * off.translation_m, off.rotation_rad / kDeg,
      metres ? 1e3 * found.rms_before : found.rms_before,
      metres ? 1e3 * found.rms_after : found.rms_after, metres ? "mm" : found.unit.c_str(),
      found.measurements, found.views, 1e3 * found.sigma_m.tail(3 - first_axis).maxCoeff(),
      found.sigma_rad.tail(3 - first_axis).maxCoeff() / kDeg);
}

/// A part that the robot can do without: believed if it lies within tolerance of the nominal
/// mounting, else the nominal one stays. @return the line for the report.
std::string believe(const char* what, const Result<Extrinsics>& found, const RobotGeometry& nominal,
                    PoseConfig RobotCalibration::*pose, RobotCalibration& calibration,
                    int first_axis = 0) {
  if (!found) return fmt::format("{}: stays nominal; {}", what, found.error().message);
  RobotCalibration with = calibration;
  with.*pose = poseConfig(found->X_parent_sensor);
  if (const auto believed = with.applyTo(nominal); !believed)
    return fmt::format("{}: stays nominal; {}", what, believed.error().message);
  const PoseConfig before = std::exchange(calibration.*pose, with.*pose);
  return line(what, *found, before, first_axis);
}

/// Both lines of the nozzle: its mounting, and what the pumps give.
std::string nozzleLine(const NozzleCalibration& found, std::string mounting) {
  return mounting + fmt::format("; the pumps give {:.1f} +- {:.1f} % of their nominal flow",
                                1e2 * found.flow, 1e2 * found.flow_sigma);
}

bool isPose(const PoseConfig& pose, const Extrinsics& found) {
  return difference(pose.pose(), found.X_parent_sensor).translation_m < 1e-6;
}

Result<CalibrationResult> beginWith(const RobotGeometry& nominal, const LidarCalibration& lidar,
                                    const std::optional<ThermalCalibration>& thermal) {
  CalibrationResult out{lidar, thermal, std::nullopt, std::nullopt, RobotCalibration::of(nominal),
                        {}};
  RobotCalibration& c = out.calibration;
  c.X_flange_lidar = poseConfig(lidar.flange_lidar.X_parent_sensor);
  c.lidar_range_bias_m.assign(lidar.range_bias_m.begin(), lidar.range_bias_m.end());
  if (thermal) c.X_flange_thermal = poseConfig(thermal->flange_thermal.X_parent_sensor);
  if (auto sane = c.applyTo(nominal); !sane) return tl::make_unexpected(sane.error());
  out.report = {line("LiDAR", lidar.flange_lidar, nominal.X_flange_lidar)};
  if (thermal)
    out.report.push_back(line("thermal camera", thermal->flange_thermal, nominal.X_flange_thermal));
  return out;
}

void addNozzle(CalibrationResult& out, const RobotGeometry& nominal,
               const Result<NozzleCalibration>& nozzle) {
  RobotCalibration& c = out.calibration;
  const auto mounting = nozzle.map([](const NozzleCalibration& n) { return n.flange_nozzle; });
  std::string told = believe("nozzle", mounting, nominal, &RobotCalibration::X_flange_nozzle, c, 1);
  if (nozzle && isPose(c.X_flange_nozzle, nozzle->flange_nozzle)) {
    out.nozzle = *nozzle;
    told = nozzleLine(*nozzle, std::move(told));
  }
  out.report.push_back(std::move(told));
}

void addCamera(CalibrationResult& out, const RobotGeometry& nominal,
               const Result<Extrinsics>& camera) {
  RobotCalibration& c = out.calibration;
  out.report.push_back(
      believe("operator camera", camera, nominal, &RobotCalibration::X_base_operatorcamera, c));
  if (camera && isPose(c.X_base_operatorcamera, *camera)) out.operator_camera = *camera;
}

}  // namespace

Result<CalibrationResult> calibrateRobot(const CalibrationRoutineConfig& config,
                                         const RobotGeometry& nominal, const CalibrationYard& yard,
                                         CalibrationDevices devices) {
  if (devices.thermal && yard.site.places.empty())
    return makeError(ErrorCode::InvalidInput, "the yard's map has no hot plate (sites)");
  const bool has_camera = devices.operator_camera != nullptr;
  CalibrationRig rig(config.rig, nominal, yard, std::move(devices));
  const auto tell = [&rig](const char* what) {
    logger("calibrate")->info("{} at {:.0f} s", what, toSeconds(rig.clock().now()));
  };
  if (auto on = rig.startSensors(); !on) return tl::make_unexpected(on.error());
  CameraPart camera(config.camera);
  const auto scans = collectScans(rig, config.lidar_postures, [&] {
    if (has_camera) camera.look(rig);
  });
  if (!scans) return tl::make_unexpected(scans.error());
  rig.restLidar();
  const auto lidar = LidarCalibrator(config.lidar).calibrate(*scans, nominal.X_flange_lidar.pose());
  if (!lidar) return tl::make_unexpected(lidar.error());
  tell("LiDAR done");
  std::optional<ThermalCalibration> thermal;
  if (rig.hasThermal()) {
    auto found = calibrateThermal(rig, config.thermal);
    if (!found) return tl::make_unexpected(found.error());
    thermal = std::move(*found);
    tell("thermal camera done");
  }
  auto out = beginWith(nominal, *lidar, thermal);
  if (!out) return out;
  if (thermal && rig.hasPumps()) {
    addNozzle(*out, nominal, calibrateNozzle(rig, {*scans, *lidar, *thermal}, config.nozzle));
    tell("nozzle done");
  }
  if (has_camera) addCamera(*out, nominal, camera.calibrate(nominal));
  return out;
}

}  // namespace kiln
