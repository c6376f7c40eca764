#pragma once

#include <span>

#include <Eigen/Geometry>

namespace kiln {

/// How densely a sweep looked ahead: by the lines that its lasers drew where X of the LiDAR points.
struct SweepCoverage {
  double tilt_from_deg = 0.0, tilt_to_deg = 0.0;  ///< of the LiDAR's X against the horizon, down +
  double step_deg = 0.0;        ///< most that it turned between two scans that follow each other
  double line_gap_deg = 0.0;    ///< between neighbouring lines, mean over what all lasers swept
  double widest_gap_deg = 0.0;  ///< and the widest there
};

/// @param X_base_lidar  where the LiDAR was as it looked ahead, one a scan, in their order.
/// All zero for fewer than two.
[[nodiscard]] SweepCoverage coverageOf(std::span<const Eigen::Isometry3d> X_base_lidar);

}  // namespace kiln
