#pragma once

#include <array>
#include <span>
#include <string>

#include <Eigen/Geometry>

#include "common/core/error.h"
#include "robot/perception/calibration/extrinsics.h"

namespace ceres {
class Problem;
}

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

/// How far the flange was turned about the least used but one of its axes, radians rms: a mounting
/// is observable only if it was turned about two. @pre not empty
[[nodiscard]] double secondTurn(std::span<const Eigen::Isometry3d> X_base_flange);

/// Solves a problem of a few dozen unknowns, on one thread: the same answer each time. Error:
/// Degenerate, naming `part`, e.g. "nozzle".
[[nodiscard]] Result<void> solveMounting(ceres::Problem& problem, const std::string& part);

/// One sigma of the six unknowns of a mounting in a solved problem; as it was where the problem
/// does not hold them.
void takeSigmas(ceres::Problem& problem, const double* mount, Extrinsics& out);

}  // namespace kiln
