#pragma once

#include "robot/evaluation/calibration/calibration_rig.h"
#include "robot/perception/calibration/lidar_calibration.h"

namespace kiln {

/// Still scans of the yard's walls from postures around and above the drive pose, turned about all
/// three axes; without the robot itself.
/// @param also  done at every posture.
[[nodiscard]] Result<std::vector<StillScan>> collectScans(CalibrationRig& rig, int postures,
                                                          const std::function<void()>& also);

}  // namespace kiln
