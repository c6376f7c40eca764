#pragma once

#include <span>
#include <string>

#include "robot/evaluation/calibration/calibration_rig.h"
#include "robot/missions/fire/skills/spray_calibration.h"
#include "robot/perception/calibration/nozzle_calibration.h"
#include "robot/perception/calibration/thermal_calibration.h"
#include "robot/perception/calibration/wet_spot.h"

namespace kiln {

struct NozzlePartConfig {
  std::string board = "spray board";  ///< the warm wall of the yard's map
  int postures = 16;
  double first_look_s = 0.8;  ///< after switching on: the pumps have spun up, the jet stands
  double spray_s = 4.0;       ///< between the two pictures
  double drain_s = 0.5;       ///< after switching off, before the arm moves
  SprayCalibration jet;       ///< what aiming believes of the jet
  WetSpotConfig spot;
  NozzleCalibrator::Config calibrator;
};

/// What the LiDAR and the thermal camera have found before.
struct NozzleReferences {
  std::span<const StillScan> scans;
  const LidarCalibration& lidar;
  const ThermalCalibration& thermal;
};

/// Finds the warm board in the scans, sprays on it from near and far with the head rolled, and
/// calibrates the nozzle by where the thermal camera sees the water land. The pumps are off when it
/// returns.
[[nodiscard]] Result<NozzleCalibration> calibrateNozzle(CalibrationRig& rig,
                                                        const NozzleReferences& found,
                                                        const NozzlePartConfig& config);

}  // namespace kiln
