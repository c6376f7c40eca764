#pragma once

#include <vector>

#include <Eigen/Core>

namespace kiln {

struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;
  void quad(int a, int b, int c, int d) {
    triangles.emplace_back(a, b, c);
    triangles.emplace_back(a, c, d);
  }
};

[[nodiscard]] TriangleMesh unitBox();  ///< edges 1, centred
[[nodiscard]] TriangleMesh
unitCylinder();                           ///< radius 1, height 1 along Z, centred, closed; 32 sides
[[nodiscard]] TriangleMesh unitSphere();  ///< radius 1; 12 rings of 24

/// A box with its edges cut off at 45 degrees, `cut_m` deep on both faces. @pre 2 cut_m < each side
[[nodiscard]] TriangleMesh cutBox(const Eigen::Vector3d& size_m, double cut_m);

enum class Outline { Round, Square };
/// A plate with a round hole, closed. X from -thickness_m to 0, the hole's axis along X.
/// @param half_m  radius of a round outline, half the edge of a square one.
/// @pre hole_radius_m < half_m
[[nodiscard]] TriangleMesh holedPlate(double hole_radius_m, Outline outline, double half_m,
                                      double thickness_m);

}  // namespace kiln
