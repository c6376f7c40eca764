#pragma once

#include <string>

#include "robot/evaluation/calibration/calibration_routine.h"

namespace kiln {

/// The operator's routine, run on the robot of one seed in the simulated yard.
struct YardCalibration {
  CalibrationResult found;
  double simulated_s = 0.0;
  std::string truth_json;  ///< the world's report, with the true mounting poses
};

/// The robot as it was drawn.
[[nodiscard]] Result<RobotGeometry> nominalRobot();

/// Starts the yard in lockstep, calibrates, ends it. Same seed and build: the same result.
[[nodiscard]] Result<YardCalibration> calibrateInYard(int seed);

/// The YAML that kiln-robotd --calibration loads.
[[nodiscard]] std::string calibrationFile(const YardCalibration& done, int seed);

/// Where sweeps keep the calibrations: $XDG_CACHE_HOME/kiln/calibration, or below ~/.cache.
[[nodiscard]] std::string calibrationCache();

/// Calibration file of this seed's robot, from `folder` or made and kept there. Its name holds a
/// fingerprint of programs, yard and robot: after a change of any of them it is made anew. Safe to
/// call from several threads for different seeds.
[[nodiscard]] Result<std::string> calibrationOf(int seed, const std::string& folder);

}  // namespace kiln
