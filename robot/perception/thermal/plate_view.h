#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "common/geom/camera_model.h"

namespace kiln::thermal {

/// A round hot plate behind an opening in an opaque front. Plate frame: origin in the plate's
/// centre, Z out through the opening, X horizontal, Y up.
struct PlateModel {
  double diameter_m = 0.15;
  double opening_m = 0.15;     ///< diameter of the round opening, parallel to the plate
  double recess_m = 0.10;      ///< plate behind the opening
  double psf_sigma_px = 0.58;  ///< optics and pixel together
};

/// What one picture of it yields.
struct PlateObservation {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  ///< of the visible part
  double area_px = 0.0;                                 ///< above half maximum
};

/// The part of the plate that is visible through the opening, as an image: the disc is clipped by
/// the opening's shadow (a disc too; it wanders across the plate as the camera moves off the axis),
/// then projected. The blur shrinks the half-maximum area of a disc by pi * sigma^2.
/// @return nullopt if the camera is not in front of the opening or nothing of the plate is visible.
[[nodiscard]] std::optional<PlateObservation> viewPlate(const PlateModel& model,
                                                        const CameraModel& camera,
                                                        const Eigen::Isometry3d& X_camera_plate);

/// Pose of the plate from its centre and outward normal (need not be unit; horizontal X axis).
/// @pre normal is not vertical.
[[nodiscard]] Eigen::Isometry3d platePose(const Eigen::Vector3d& p, const Eigen::Vector3d& normal);

}  // namespace kiln::thermal
