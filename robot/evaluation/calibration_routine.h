#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/core/clock.h"
#include "common/robot_model/robot_calibration.h"
#include "robot/control/arm_controller.h"
#include "robot/hal/lidar.h"
#include "robot/hal/rgb_camera.h"
#include "robot/hal/thermal_camera.h"
#include "robot/perception/calibration/camera_calibration.h"
#include "robot/perception/calibration/lidar_calibration.h"
#include "robot/perception/calibration/thermal_calibration.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// What the calibration works with: the robot's devices, whoever stands behind them.
struct CalibrationDevices {
  Arm& arm;
  Lidar& lidar;
  ThermalCamera& thermal;
  RgbCamera& operator_camera;
  const Clock& clock;
  /// Lets one control period pass: writes what was commanded, delivers what was measured.
  std::function<Result<void>()> step;
};

/// What it found.
struct CalibrationResult {
  LidarCalibration lidar;
  ThermalCalibration thermal;
  std::optional<Extrinsics> operator_camera;  ///< nullopt: see the report
  RobotCalibration calibration;               ///< to be written
  std::vector<std::string> report;            ///< one line a sensor, for the operator
};

/// The operator's routine: base at rest, arm through some fifty postures; the LiDAR looks at the
/// walls, the thermal camera at a hot plate before the robot, the operator camera at the robot's
/// own deck. The nozzle cannot be seen by any sensor on board and stays nominal. Blocks; confined
/// to one thread.
class CalibrationRoutine {
 public:
  struct Config {
    int lidar_postures = 14;
    int scans_a_posture = 1;
    int thermal_postures = 18;
    int images_a_posture = 2;
    double speed_scale = 0.5;         ///< of the joint limits; the base stands, nobody is near
    double settle_s = 0.3;            ///< after a motion, before anything is measured
    double plate_threshold_c = 75.0;  ///< the plate must be hotter
    double plate_wait_s = 120.0;      ///< for it
    LidarCalibrator::Config lidar;
    ThermalCalibrator::Config thermal;
    CameraCalibrator::Config camera;
  };
  CalibrationRoutine(const Config& config, const RobotGeometry& nominal, const ArenaMap& yard,
                     CalibrationDevices devices);
  ~CalibrationRoutine();
  /// Errors say what to do: no scans, no hot plate in view, arm blocked.
  [[nodiscard]] Result<CalibrationResult> run();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
