#pragma once

#include <limits>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace kiln {

/// Which planes count and how many are tried. Frame: that of the points, metres.
struct PlaneSearch {
  Eigen::Vector3d towards = Eigen::Vector3d::UnitZ();       ///< unit; the normal faces this way
  double within_rad = 0.2;                                  ///< of it, at most
  Eigen::Vector3d near = Eigen::Vector3d::Zero();           ///< the plane passes it
  double near_m = std::numeric_limits<double>::infinity();  ///< by no more than this
  double tolerance_m = 0.03;                                ///< of a point on the plane
  double least_m2 = 1e-3;  ///< twice the area of the triangle drawn; a smaller one says nothing
  int trials = 150;
  unsigned seed = 1;  ///< the same points, the same plane
  std::size_t most_voters = std::numeric_limits<std::size_t>::max();  ///< every k-th point votes
};

/// n . p = d.
struct SupportedPlane {
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  double d_m = 0.0;
  std::size_t votes = 0;  ///< voters within the tolerance
};

/// The plane through three of the points that most of them lie on (RANSAC); nullopt: none counts.
/// What follows, a least-squares fit, is the caller's.
[[nodiscard]] std::optional<SupportedPlane> searchPlane(std::span<const Eigen::Vector3d> points,
                                                        const PlaneSearch& search);

}  // namespace kiln
