#pragma once

#include <span>

#include "robot/perception/thermal/plate_view.h"

namespace kiln::thermal {

/// One picture of the plate, from where.
struct PlateMeasurement {
  Eigen::Isometry3d X_map_camera =
      Eigen::Isometry3d::Identity();  ///< nominal: with the unknown extrinsic error
  PlateObservation seen;
};

/// One sigma of everything that is not known exactly.
struct PlateFitNoise {
  double centre_px = 0.5;        ///< blob centre, each axis, each picture
  double radius_px = 0.25;       ///< equivalent radius of the blob, each picture
  double size_ratio = 0.015;     ///< plate size and focal length, common to all pictures
  double normal_yaw_rad = 0.09;  ///< the fire box stands askew
  double extrinsic_m = 0.005;    ///< camera on the flange, each axis, common to all pictures
  double extrinsic_rad = 0.0052;
  double robust_px = 1.5;  ///< residuals beyond this many sigmas count less (Cauchy)
};

struct PlateFit {
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Identity();  ///< marginal, systematic errors included
  double normal_yaw_offset_rad = 0.0;
  double rms = 0.0;  ///< of the whitened residuals; about 1 when the noise model fits
  int iterations = 0;
  bool converged = false;
};

/// Maximum a-posteriori fit of the plate's position to all pictures of a sweep: blob centres
/// (triangulation) and blob areas (size) together, with the errors that all pictures share
/// (extrinsics, plate size, yaw of the box) as parameters of their own with priors; so neither
/// source of distance is trusted more than it deserves. Levenberg-Marquardt, 11 parameters, numeric
/// derivatives.
/// @pre measurements is not empty; initial lies in front of the cameras.
[[nodiscard]] PlateFit fitPlate(const PlateModel& model, const CameraModel& camera,
                                std::span<const PlateMeasurement> measurements,
                                const Eigen::Vector3d& initial, const Eigen::Vector3d& normal,
                                const PlateFitNoise& noise);

}  // namespace kiln::thermal
