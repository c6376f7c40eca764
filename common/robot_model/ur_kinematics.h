#pragma once

#include <array>

#include "common/geom/pose.h"

namespace kiln {

/// Standard DH of a UR e-Series arm: T = prod Rz(q) Tz(d) Tx(a) Rx(alpha). Metres, radians.
struct UrKinematics {
  std::array<double, 6> a{};
  std::array<double, 6> d{};
  std::array<double, 6> alpha{};
  Vector6d velocity_limit = Vector6d::Zero();  ///< rad/s
  Vector6d position_limit = Vector6d::Zero();  ///< +- rad

  /// Vendor's UR10e figures (hardware.md of the vendor's kinematics file; nominal, uncalibrated).
  [[nodiscard]] static UrKinematics ur10e();
  /// X_armbase_flange (DH frame 6, Z out of the flange).
  [[nodiscard]] Eigen::Isometry3d forward(const Vector6d& q) const;
  /// Poses of DH frames 1..6 in arm_base; index 5 equals forward(q).
  [[nodiscard]] std::array<Eigen::Isometry3d, 6> frames(const Vector6d& q) const;
  /// Geometric Jacobian at the flange origin, expressed in arm_base: rows 0-2 linear, 3-5 angular.
  [[nodiscard]] Eigen::Matrix<double, 6, 6> jacobian(const Vector6d& q) const;
};

}  // namespace kiln
