#include "robot/scene/primitive_meshes.h"

#include <cmath>

namespace kiln {
namespace {
constexpr int kCylinderSides = 32;
constexpr int kSphereRings = 12;
constexpr int kHoleSides = 64;  // a multiple of 8: a square outline has its corners among them
}  // namespace

TriangleMesh unitBox() {
  TriangleMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.emplace_back(i & 1 ? .5F : -.5F, i & 2 ? .5F : -.5F, i & 4 ? .5F : -.5F);
  m.quad(0, 2, 3, 1);
  m.quad(4, 5, 7, 6);
  m.quad(0, 1, 5, 4);
  m.quad(2, 6, 7, 3);
  m.quad(0, 4, 6, 2);
  m.quad(1, 3, 7, 5);
  return m;
}

TriangleMesh unitCylinder() {
  TriangleMesh m;
  for (int i = 0; i < kCylinderSides; ++i) {
    const double angle = 2.0 * M_PI * i / kCylinderSides;
    const float x = static_cast<float>(std::cos(angle)), y = static_cast<float>(std::sin(angle));
    m.vertices.emplace_back(x, y, -.5F);
    m.vertices.emplace_back(x, y, .5F);
  }
  const int bottom = 2 * kCylinderSides, top = bottom + 1;
  m.vertices.emplace_back(0.F, 0.F, -.5F);
  m.vertices.emplace_back(0.F, 0.F, .5F);
  for (int i = 0; i < kCylinderSides; ++i) {
    const int j = (i + 1) % kCylinderSides;
    m.quad(2 * i, 2 * j, 2 * j + 1, 2 * i + 1);
    m.triangles.emplace_back(bottom, 2 * j, 2 * i);
    m.triangles.emplace_back(top, 2 * i + 1, 2 * j + 1);
  }
  return m;
}

TriangleMesh unitSphere() {
  TriangleMesh m;
  const int sides = 2 * kSphereRings;
  for (int r = 0; r <= kSphereRings; ++r) {
    const double polar = M_PI * r / kSphereRings;
    for (int s = 0; s < sides; ++s) {
      const double angle = 2.0 * M_PI * s / sides;
      m.vertices.emplace_back(static_cast<float>(std::sin(polar) * std::cos(angle)),
                              static_cast<float>(std::sin(polar) * std::sin(angle)),
                              static_cast<float>(std::cos(polar)));
    }
  }
  for (int r = 0; r < kSphereRings; ++r) {
    for (int s = 0; s < sides; ++s) {
      const int t = (s + 1) % sides;
      m.quad(r * sides + s, (r + 1) * sides + s, (r + 1) * sides + t, r * sides + t);
    }
  }
  return m;
}

TriangleMesh cutBox(const Eigen::Vector3d& size_m, double cut_m) {
  TriangleMesh m;
  // Corner i has three vertices: vertex 3 i + axis lies on the face across that axis.
  const auto side = [](int corner, int axis) { return (corner >> axis & 1) != 0 ? 0.5 : -0.5; };
  for (int corner = 0; corner < 8; ++corner) {
    for (int face = 0; face < 3; ++face) {
      Eigen::Vector3d p;
      for (int axis = 0; axis < 3; ++axis) {
        const double s = side(corner, axis);
        p[axis] = s * (size_m[axis] - (axis == face ? 0.0 : 2.0 * cut_m));
      }
      m.vertices.push_back(p.cast<float>());
    }
    m.triangles.emplace_back(3 * corner, 3 * corner + 1, 3 * corner + 2);
  }
  for (int face = 0; face < 3; ++face) {
    const int u = 1 << (face + 1) % 3, v = 1 << (face + 2) % 3, n = 1 << face;
    for (const int c : {0, n})
      m.quad(3 * c + face, 3 * (c | u) + face, 3 * (c | u | v) + face, 3 * (c | v) + face);
    // The edges along this axis join the faces across the two others.
    const int a = (face + 1) % 3, b = (face + 2) % 3;
    for (const int c : {0, u, v, u | v})
      m.quad(3 * c + a, 3 * c + b, 3 * (c | n) + b, 3 * (c | n) + a);
  }
  return m;
}

TriangleMesh holedPlate(double hole_radius_m, Outline outline, double half_m, double thickness_m) {
  TriangleMesh m;
  for (int i = 0; i < kHoleSides; ++i) {
    const double angle = 2.0 * M_PI * i / kHoleSides;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const double outer =
        outline == Outline::Round ? half_m : half_m / direction.cwiseAbs().maxCoeff();
    for (const double r : {hole_radius_m, outer}) {
      for (const double x : {-thickness_m, 0.0})
        m.vertices.push_back(
            Eigen::Vector3d(x, r * direction.x(), r * direction.y()).cast<float>());
    }
  }
  for (int i = 0; i < kHoleSides; ++i) {
    const int a = 4 * i, b = 4 * ((i + 1) % kHoleSides);  // hole back, front, outline back, front
    m.quad(a + 1, a + 3, b + 3, b + 1);
    m.quad(a, b, b + 2, a + 2);
    m.quad(a, a + 1, b + 1, b);
    m.quad(a + 2, b + 2, b + 3, a + 3);
  }
  return m;
}

}  // namespace kiln
