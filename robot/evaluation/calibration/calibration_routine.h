#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/robot_model/robot_calibration.h"
#include "robot/evaluation/calibration/calibration_rig.h"
#include "robot/evaluation/calibration/nozzle_part.h"
#include "robot/evaluation/calibration/thermal_part.h"
#include "robot/perception/calibration/camera_calibration.h"

namespace kiln {

/// What it found.
struct CalibrationResult {
  LidarCalibration lidar;
  std::optional<ThermalCalibration> thermal;  ///< nullopt: the robot has no such camera
  std::optional<NozzleCalibration> nozzle;    ///< nullopt: stays nominal, see the report
  std::optional<Extrinsics> operator_camera;  ///< the same
  RobotCalibration calibration;               ///< to be written
  std::vector<std::string> report;            ///< one line a sensor, for the operator
};

struct CalibrationRoutineConfig {
  CalibrationRig::Config rig;
  int lidar_postures = 14;
  LidarCalibrator::Config lidar;
  ThermalPartConfig thermal;
  NozzlePartConfig nozzle;
  CameraCalibrator::Config camera;
};

/// The operator's routine: base at rest, arm through some fifty postures; the LiDAR looks at the
/// walls, the thermal camera at a hot plate before the robot, the operator camera at the robot
/// itself, and the thermal camera at water that the nozzle sprays on a warm board. Blocks; one
/// thread. Errors say what to do: no scans, no hot plate in view, arm blocked. A nozzle or operator
/// camera that cannot be calibrated stays nominal; of what the robot lacks nothing is asked or said.
[[nodiscard]] Result<CalibrationResult> calibrateRobot(const CalibrationRoutineConfig& config,
                                                       const RobotGeometry& nominal,
                                                       const CalibrationYard& yard,
                                                       CalibrationDevices devices);

}  // namespace kiln
