#include "common/robot_model/ur_kinematics.h"

#include <cmath>

#include "common/core/units.h"

namespace kiln {

UrKinematics UrKinematics::ur10e() {
  UrKinematics k;
  k.a = {0.0, -0.6127, -0.57155, 0.0, 0.0, 0.0};
  k.d = {0.1807, 0.0, 0.0, 0.17415, 0.11985, 0.11655};
  k.alpha = {M_PI / 2, 0.0, 0.0, M_PI / 2, -M_PI / 2, 0.0};
  k.velocity_limit << 120 * kDeg, 120 * kDeg, 180 * kDeg, 180 * kDeg, 180 * kDeg, 180 * kDeg;
  k.position_limit << 2 * M_PI, 2 * M_PI, M_PI, 2 * M_PI, 2 * M_PI, 2 * M_PI;
  return k;
}

std::array<Eigen::Isometry3d, 6> UrKinematics::frames(const Vector6d& q) const {
  std::array<Eigen::Isometry3d, 6> out;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < 6; ++i) {
    X = X * Eigen::AngleAxisd(q[static_cast<Eigen::Index>(i)], Eigen::Vector3d::UnitZ()) *
        Eigen::Translation3d(a[i], 0.0, d[i]) *
        Eigen::AngleAxisd(alpha[i], Eigen::Vector3d::UnitX());
    out[i] = X;
  }
  return out;
}

Eigen::Isometry3d UrKinematics::forward(const Vector6d& q) const { return frames(q)[5]; }

Eigen::Matrix<double, 6, 6> UrKinematics::jacobian(const Vector6d& q) const {
  const auto X = frames(q);
  Eigen::Matrix<double, 6, 6> J;
  const Eigen::Vector3d tip = X[5].translation();
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d axis =
        i == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(X[i - 1].linear().col(2));
    const Eigen::Vector3d origin =
        i == 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(X[i - 1].translation());
    J.block<3, 1>(0, i) = axis.cross(tip - origin);
    J.block<3, 1>(3, i) = axis;
  }
  return J;
}

}  // namespace kiln
