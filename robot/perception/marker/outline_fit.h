#pragma once

#include <span>
#include <vector>

#include "common/config/config_archive.h"
#include "common/geom/pose.h"

namespace kiln::marker {

/// From where a picture was taken. Level frame: origin of `base`, Z upright on the ground at the
/// marker, X as near to the base's as that allows.
struct PictureFrame {
  Eigen::Isometry3d X_level_rgb = Eigen::Isometry3d::Identity();
  double ground_m = 0.0;  ///< height of the ground at the marker, level frame
  Pose2 X_odom_level;
  double drift_m = 0.0;  ///< of the odometry between this picture and the newest, one sigma

  /// Where a viewing ray (camera frame) meets the ground, in odom; NaN if it does not.
  [[nodiscard]] Eigen::Vector2d onGround(const Eigen::Vector3d& direction_rgb) const;
};

/// A point of the marker's outline as a picture shows it.
struct SeenOutline {
  std::size_t frame = 0;
  Eigen::Vector3d direction_rgb;  ///< viewing ray, z = 1
  Eigen::Vector2d outward;        ///< unit, in the picture
  double focal_px = 1.0;
};

/// What is known beforehand, one sigma each.
struct OutlinePrior {
  double camera_rad = 0.0;                               ///< mounting, each axis
  double camera_m = 0.0;                                 ///< mounting, each axis
  Eigen::Matrix3d ground = Eigen::Matrix3d::Identity();  ///< covariance of GroundPlane
};

struct OutlineFitConfig {
  double sigma_px = 1.0;         ///< of a point of the outline
  double offset_sigma_px = 1.0;  ///< of the mask's edge against the marker's, common to all points
  int max_points = 3000;         ///< used, thinned evenly
  double independent_points = 60;  ///< as many the points are worth: neighbours err together
  double first_gate_m = 1.2;
  double last_gate_sigma = 3.5;
  int rounds = 6;  ///< of assigning and fitting, the gate halved each time
  void visit(ConfigArchive& a);
};

struct OutlineFit {
  bool converged = false;
  Pose2 X_odom_wall;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();   ///< x, y, yaw; all common errors included
  Eigen::Vector3d camera_turn = Eigen::Vector3d::Zero();  ///< rad, camera axes, against nominal
  Eigen::Vector3d ground = Eigen::Vector3d::Zero();  ///< of the plane's coefficients, level frame
  double offset_px = 0.0;
  double agreeing_share = 0.0;  ///< of the outline's points within the last gate
  double rms_sigma = 0.0;       ///< of those
  /// A viewing ray on the ground, in odom, with the errors that the fit found.
  [[nodiscard]] Eigen::Vector2d onGround(const PictureFrame& frame,
                                         const Eigen::Vector3d& direction_rgb) const;
};

/// Lays the marker's outline over what all pictures show of it. Unknown are pose of the marker,
/// mounting of the camera, the ground's plane and how far the masks' edges are off: the marker's
/// known size tells its distance, far better than tilt and height of the camera do.
/// Maximum a posteriori with a Cauchy kernel (Ceres); each point belongs to the nearest side of the
/// outline that faces the same way, looked up anew each round.
/// @param start  pose of the wall frame in odom.
[[nodiscard]] OutlineFit fitOutline(std::span<const PictureFrame> frames,
                                    std::span<const SeenOutline> outline, const Pose2& start,
                                    const OutlinePrior& prior, const OutlineFitConfig& config);

}  // namespace kiln::marker
