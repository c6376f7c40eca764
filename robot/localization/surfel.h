#pragma once

#include <Eigen/Core>

namespace kiln {

/// Sums over the points of one surface element, in map metres: additive, so that scans can be put
/// in and taken out again and that a coarse cell is the sum of its fine ones.
struct SurfelMoments {
  double count = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();   ///< sum of p p^T
  Eigen::Vector3d view_sum = Eigen::Vector3d::Zero();  ///< of unit vectors from point to sensor

  void add(const Eigen::Vector3d& p, const Eigen::Vector3d& view);
  SurfelMoments& operator+=(const SurfelMoments& other);
  SurfelMoments& operator-=(const SurfelMoments& other);
  /// @pre count > 0.
  [[nodiscard]] Eigen::Vector3d mean() const { return sum / count; }
  /// @pre count > 0. Symmetric; not corrected for small samples.
  [[nodiscard]] Eigen::Matrix3d covariance() const;
};

/// A plane through part of a cell, as registration uses it.
struct Surfel {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();    ///< map, metres
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, map, towards where it was seen from
  float normal_variance = 0.0F;                      ///< of the points along `normal`, m^2
  float extent_variance = 0.0F;                      ///< larger one within the plane, m^2
  float count = 0.0F;                                ///< points
  bool planar = false;  ///< false: too few points, a line, or a lump; not used for matching
};

/// @param own     moments of the cell.
/// @param around  the cell with its neighbours on the same surface: gives a steadier normal, where
///                it is planar; `own` alone is asked otherwise.
/// @param cell_m  edge length of the cell.
[[nodiscard]] Surfel makeSurfel(const SurfelMoments& own, const SurfelMoments& around,
                                double cell_m);

}  // namespace kiln
