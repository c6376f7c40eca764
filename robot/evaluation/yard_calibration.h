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

/// A robot, and the world in which it is calibrated.
struct Yard {
  std::string robot;  ///< resource
  std::string world;  ///< its name
};
/// For the robot of a world (file or name; empty: the fire's). Error: InvalidInput: that robot has
/// no yard, names those that do.
[[nodiscard]] Result<Yard> yardOf(const std::string& world);

/// The robot of the fire mission as it was drawn.
[[nodiscard]] Result<RobotGeometry> nominalRobot();

/// Starts the yard in lockstep, calibrates, ends it. Same seed and build: the same result.
[[nodiscard]] Result<YardCalibration> calibrateInYard(const Yard& yard, int seed);

/// The YAML that kiln-robotd --calibration loads.
[[nodiscard]] std::string calibrationFile(const YardCalibration& done, int seed);

/// Where sweeps keep the calibrations: $XDG_CACHE_HOME/kiln/calibration, or below ~/.cache.
[[nodiscard]] std::string calibrationCache();

/// Calibration file of this seed's robot, from `folder` or made and kept there. Its name holds a
/// fingerprint of programs, yard and robot: after a change of any of them it is made anew. Safe to
/// call from several threads for different seeds.
[[nodiscard]] Result<std::string> calibrationOf(const Yard& yard, int seed,
                                                const std::string& folder);

}  // namespace kiln
