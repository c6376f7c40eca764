#pragma once

#include "robot/evaluation/calibration/calibration_rig.h"
#include "robot/perception/calibration/thermal_calibration.h"

namespace kiln {

struct ThermalPartConfig {
  int postures = 18;
  int images_a_posture = 2;
  double plate_wait_s = 120.0;  ///< for a plate that is hot
  ThermalCalibrator::Config calibrator;
};

/// Looks at the yard's hot plate from many postures and calibrates the thermal camera.
/// @pre the yard's map has a fire place.
[[nodiscard]] Result<ThermalCalibration> calibrateThermal(CalibrationRig& rig,
                                                          const ThermalPartConfig& config);

}  // namespace kiln
