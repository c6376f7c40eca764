#pragma once

#include <array>

#include <Eigen/Geometry>

namespace kiln {

/// The six unknowns of a mounting pose, about its nominal one: rotation vector (rad), then
/// translation (m), both in the mounted part's own axes.
[[nodiscard]] inline Eigen::Isometry3d mountingError(const double* x) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d turn(x[0], x[1], x[2]);
  if (turn.norm() > 0.0)
    X.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  X.translation() = Eigen::Vector3d(x[3], x[4], x[5]);
  return X;
}

/// Cost functor: N unknowns are thought to be 0, each within one sigma.
template <int N>
struct Prior {
  std::array<double, N> sigma;
  template <class T>
  bool operator()(const T* x, T* residual) const {
    for (std::size_t i = 0; i < N; ++i) residual[i] = x[i] / sigma[i];
    return true;
  }
};

}  // namespace kiln
