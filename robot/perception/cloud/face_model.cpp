#include "robot/perception/cloud/face_model.h"

#include <algorithm>
#include <cmath>

namespace kiln {

void appendBoxFaces(std::vector<Face>& faces, const Eigen::Vector3d& low,
                    const Eigen::Vector3d& high) {
  const Eigen::Vector3d centre = 0.5 * (low + high), half = 0.5 * (high - low);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Face face;
      face.n = side * Eigen::Vector3d::Unit(axis);
      face.u = Eigen::Vector3d::Unit((axis + 1) % 3);
      face.v = face.n.cross(face.u);
      face.centre = centre + side * half[axis] * Eigen::Vector3d::Unit(axis);
      face.half_u = half[(axis + 1) % 3];
      face.half_v = half[(axis + 2) % 3];
      faces.push_back(face);
    }
  }
}

/// The front of a flat ring about X, as rectangles side by side.
void appendRingFront(std::vector<Face>& faces, double inner_radius, double width) {
  constexpr int kSides = 12;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * M_PI * i / kSides;
    Face face;
    face.n = Eigen::Vector3d::UnitX();
    face.u = Eigen::Vector3d(0, std::cos(angle), std::sin(angle));
    face.v = face.n.cross(face.u);
    face.half_u = 0.5 * width;
    face.centre = (inner_radius + face.half_u) * face.u;
    face.half_v = face.centre.norm() * std::tan(M_PI / kSides);
    faces.push_back(face);
  }
}

std::vector<Face> fireBoxFaces(const FireBoxSizes& s) {
  std::vector<Face> faces;
  const double half = 0.5 * s.box, f = s.bar;
  for (const double side : {-1.0, 1.0}) {
    const double y0 = side < 0 ? -half : half - f;
    for (const double z0 : {-half, half - f})  // along X
      appendBoxFaces(faces, {-s.box, y0, z0}, {0, y0 + f, z0 + f});
    for (const double x0 : {-s.box, -f}) {
      appendBoxFaces(faces, {x0, y0, -half + f}, {x0 + f, y0 + f, half - f});  // upright
      appendBoxFaces(faces, {x0, -half + f, y0}, {x0 + f, half - f, y0 + f});  // along Y
    }
  }
  appendRingFront(faces, 0.5 * s.opening, s.rim);
  appendBoxFaces(faces, {s.table_ahead - s.table, -0.5 * s.table, -half - s.table_height},
                 {s.table_ahead, 0.5 * s.table, -half});
  return faces;
}

std::optional<FacePoint> nearestFace(std::span<const Face> faces, const Eigen::Vector3d& p,
                                     const Eigen::Vector3d& p_sensor, double gate_m) {
  FacePoint best;
  best.distance_m = gate_m;
  for (const Face& face : faces) {
    const Eigen::Vector3d d = p - face.centre;
    const double off = d.dot(face.n);
    if (std::abs(off) >= best.distance_m || (p_sensor - face.centre).dot(face.n) <= 0.0) continue;
    const double a = d.dot(face.u), b = d.dot(face.v);
    const double ca = std::clamp(a, -face.half_u, face.half_u),
                 cb = std::clamp(b, -face.half_v, face.half_v);
    const double distance = Eigen::Vector3d(off, a - ca, b - cb).norm();
    if (distance >= best.distance_m) continue;
    best = {&face, face.centre + ca * face.u + cb * face.v, distance};
  }
  return best.face ? std::optional(best) : std::nullopt;
}

}  // namespace kiln
