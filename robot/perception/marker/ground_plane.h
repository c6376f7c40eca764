#pragma once

#include <Eigen/Geometry>

#include "common/config/config_archive.h"
#include "common/core/error.h"
#include "common/model/sensor.h"

namespace kiln {

/// The ground in one place as a plane in `base`: z = coefficients . (1, x, y), metres. Its tilt is
/// pitch and roll of the base against that ground.
struct GroundPlane {
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the coefficients
  [[nodiscard]] Eigen::Vector3d normal() const;          ///< unit, upwards
  [[nodiscard]] double height(double x, double y) const {
    return coefficients.dot(Eigen::Vector3d(1.0, x, y));
  }
  /// Where a ray meets it. @return NaN if it does not. @param origin, direction  in `base`.
  [[nodiscard]] Eigen::Vector3d meet(const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction) const;
  /// The plane under the wheels of a base that neither pitches nor rolls.
  [[nodiscard]] static GroundPlane flat() { return {}; }
};

struct GroundPlaneConfig {
  double radius_m = 3.0;        ///< around the place that is asked for
  double tolerance_m = 0.03;    ///< of a point of the ground
  double max_slope_deg = 12.0;  ///< steeper is not ground
  int min_points = 40;
  double min_share = 0.3;        ///< of the points in the circle
  double lidar_sigma_deg = 0.3;  ///< mounting of the LiDAR, each axis, common to all points
  double lidar_sigma_m = 0.005;
  double noise_m = 0.01;  ///< height of a point, one sigma
  void visit(ConfigArchive& a);
};

/// The ground around a place by RANSAC and least squares in one prepared scan.
/// @param scan_base  in `base`; NaN points are skipped.
/// @param p_base     the place, metres.
/// Error: Degenerate, saying how many points there were, when too few points or no plane.
[[nodiscard]] Result<GroundPlane> fitGroundPlane(const PointCloud& scan_base,
                                                 const Eigen::Vector2d& p_base,
                                                 const GroundPlaneConfig& config);

/// The ground where a ray meets it: begins with the plane under the wheels and looks again where
/// the ray meets what was found.
/// Errors: those of fitGroundPlane(); NotFound if the ray meets no ground within `max_range_m`.
[[nodiscard]] Result<GroundPlane> groundAlongRay(const PointCloud& scan_base,
                                                 const Eigen::Vector3d& origin_base,
                                                 const Eigen::Vector3d& direction_base,
                                                 double max_range_m,
                                                 const GroundPlaneConfig& config);

}  // namespace kiln
