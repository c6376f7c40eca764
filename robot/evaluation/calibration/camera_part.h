#pragma once

#include "robot/evaluation/calibration/calibration_rig.h"
#include "robot/perception/calibration/camera_calibration.h"

namespace kiln {

/// Pictures of the operator camera, calibrated by the robot's own edges in them. @pre the arm is at
/// rest.
[[nodiscard]] Result<Extrinsics> calibrateOperatorCamera(CalibrationRig& rig,
                                                         const CameraCalibrator::Config& config);

}  // namespace kiln
