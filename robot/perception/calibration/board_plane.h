#pragma once

#include <span>

#include "robot/perception/calibration/lidar_calibration.h"

namespace kiln {

/// A flat board before the robot, in base.
struct BoardPlane {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();        ///< its middle, as far as it was seen
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit, towards the robot
  double rms_m = 0.0;                                 ///< of its points
  int points = 0;
};

/// What is known of it beforehand.
struct BoardPrior {
  BoardPlane where;
  double half_width_m = 0.8, half_height_m = 0.75;
  double within_m = 0.4, within_deg = 12.0;  ///< the robot was put down by eye
};

/// Finds the board in still scans with the calibrated LiDAR: RANSAC over points near the expected
/// place (fixed seed), then least squares.
/// @return Error{NotFound} when no upright plane stands there.
[[nodiscard]] Result<BoardPlane> findBoard(std::span<const StillScan> scans,
                                           const LidarCalibration& lidar, const BoardPrior& prior);

}  // namespace kiln
