#include "robot/localization/surfel.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace kiln {
namespace {

constexpr double kMinPoints = 5.0;
constexpr double kMaxThickness_m = 0.035;  // noise, laser biases and pose errors of the scans
constexpr double kMinWidth = 0.12;         // 1-sigma within the plane, of the cell: less is a line
constexpr double kMinFlatness = 6.0;       // second over smallest eigenvalue

struct Plane {
  Eigen::Vector3d normal;
  bool valid = false;
};

Plane fitPlane(const SurfelMoments& moments, double cell_m) {
  if (moments.count < kMinPoints) return {};
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(moments.covariance());
  const Eigen::Vector3d lambda = solver.eigenvalues().cwiseMax(0.0);
  const bool thin = lambda[0] < kMaxThickness_m * kMaxThickness_m;
  const bool wide = lambda[1] > kMinWidth * kMinWidth * cell_m * cell_m;
  return {solver.eigenvectors().col(0), thin && wide && lambda[1] > kMinFlatness * lambda[0]};
}

}  // namespace

void SurfelMoments::add(const Eigen::Vector3d& p, const Eigen::Vector3d& view) {
  count += 1.0;
  sum += p;
  squares += p * p.transpose();
  view_sum += view;
}

SurfelMoments& SurfelMoments::operator+=(const SurfelMoments& other) {
  count += other.count;
  sum += other.sum;
  squares += other.squares;
  view_sum += other.view_sum;
  return *this;
}

SurfelMoments& SurfelMoments::operator-=(const SurfelMoments& other) {
  count -= other.count;
  sum -= other.sum;
  squares -= other.squares;
  view_sum -= other.view_sum;
  return *this;
}

Eigen::Matrix3d SurfelMoments::covariance() const {
  const Eigen::Vector3d m = mean();
  return squares / count - m * m.transpose();
}

Surfel makeSurfel(const SurfelMoments& own, const SurfelMoments& around, double cell_m) {
  Surfel out;
  out.count = static_cast<float>(own.count);
  if (own.count < 0.5) return out;
  out.mean = own.mean().cast<float>();
  if (own.count < kMinPoints) return out;
  Plane plane = fitPlane(around, cell_m);
  const Eigen::Matrix3d covariance = own.covariance();
  // The neighbours' plane must hold for the cell itself: beside a corner it does not.
  const auto thickness = [&] { return plane.normal.dot(covariance * plane.normal); };
  if (!plane.valid || thickness() > kMaxThickness_m * kMaxThickness_m) {
    plane = fitPlane(own, cell_m);
  }
  if (!plane.valid) return out;
  if (plane.normal.dot(own.view_sum) < 0.0) plane.normal = -plane.normal;
  out.normal = plane.normal.cast<float>();
  out.normal_variance = static_cast<float>(std::max(0.0, thickness()));
  out.extent_variance = static_cast<float>(
      std::max(0.0, covariance.trace() - static_cast<double>(out.normal_variance)));
  out.planar = true;
  return out;
}

}  // namespace kiln
