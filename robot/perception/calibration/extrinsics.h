#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/core/error.h"

namespace kiln {

/// An estimated mounting pose, X_parent_sensor, and how well it is known.
struct Extrinsics {
  Eigen::Isometry3d X_parent_sensor = Eigen::Isometry3d::Identity();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();    ///< along the sensor's axes
  Eigen::Vector3d sigma_rad = Eigen::Vector3d::Zero();  ///< about the sensor's axes
  double rms_before = 0.0, rms_after = 0.0;  ///< residuals with the nominal and the estimated pose
  std::string unit;                          ///< of the residuals: "m" or "px"
  int views = 0, measurements = 0;
};

/// How far two mounting poses are apart: metres and radians.
struct ExtrinsicDifference {
  double translation_m = 0.0, rotation_rad = 0.0;
};
[[nodiscard]] inline ExtrinsicDifference difference(const Eigen::Isometry3d& a,
                                                    const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d d = a.inverse() * b;
  return {d.translation().norm(), Eigen::AngleAxisd(d.linear()).angle()};
}

}  // namespace kiln
