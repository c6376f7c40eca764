#pragma once

#include <vector>

#include "robot/missions/fire/skills/spray_calibration.h"

namespace kiln {

/// Predicted centre line of the jet in `map`, from the nozzle until it has fallen to the ground or
/// flown `length_m`.
/// @param X_map_nozzle  X along the jet at the exit.
/// @param step_m        spacing along the line of exit, > 0.
[[nodiscard]] std::vector<Eigen::Vector3d> jetPoints(const SprayCalibration& calibration,
                                                     const Eigen::Isometry3d& X_map_nozzle,
                                                     double flow_scale, double length_m = 2.0,
                                                     double step_m = 0.05);

/// The jet's centre at one distance along the line of exit, in `map`.
[[nodiscard]] Eigen::Vector3d jetPoint(const SprayCalibration& calibration,
                                       const Eigen::Isometry3d& X_map_nozzle, double distance_m,
                                       double flow_scale);

/// How far the jet's centre passes from a point, and where it crosses the plane through the point
/// across `normal`.
struct JetMiss {
  double distance_m = 0.0;  ///< of the crossing from the point, in the plane
  double lateral_m = 0.0;   ///< left of the point as seen along -normal
  double vertical_m = 0.0;  ///< above the point
  double angle_rad = 0.0;   ///< between the jet and -normal at the crossing
  bool reaches = false;     ///< false: the jet never crosses the plane; the rest is meaningless
};
/// @param normal_map  unit, from the point towards the nozzle.
[[nodiscard]] JetMiss jetMiss(const SprayCalibration& calibration,
                              const Eigen::Isometry3d& X_map_nozzle, const Eigen::Vector3d& p_map,
                              const Eigen::Vector3d& normal_map, double flow_scale);

}  // namespace kiln
