#pragma once

#include <Eigen/Geometry>

namespace kiln {

/// What is nearer than a radius to a segment. Metres.
struct Capsule {
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = Eigen::Vector3d::Zero();  ///< ends of the axis
  double radius = 0.0;
  [[nodiscard]] Capsule in(const Eigen::Isometry3d& X_other_frame) const {
    return {X_other_frame * a, X_other_frame * b, radius};
  }
};

}  // namespace kiln
