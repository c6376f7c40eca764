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

}  // namespace kiln
