#include "robot/perception/cloud/face_model.h"

#include <algorithm>

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

std::vector<Face> fireBoxFaces(const FireBoxSizes& s) {
  std::vector<Face> faces;
  const double half = 0.5 * s.box, f = s.bar, o = 0.5 * s.opening, r = s.rim;
  for (const double side : {-1.0, 1.0}) {
    const double y0 = side < 0 ? -half : half - f;
    for (const double z0 : {-half, half - f})  // along X
      appendBoxFaces(faces, {-s.box, y0, z0}, {0, y0 + f, z0 + f});
    for (const double x0 : {-s.box, -f}) {
      appendBoxFaces(faces, {x0, y0, -half + f}, {x0 + f, y0 + f, half - f});  // upright
      appendBoxFaces(faces, {x0, -half + f, y0}, {x0 + f, half - f, y0 + f});  // along Y
    }
    const double r0 = side < 0 ? -o - r : o;
    appendBoxFaces(faces, {-0.008, r0, -o - r}, {0, r0 + r, o + r});
    appendBoxFaces(faces, {-0.008, -o, r0}, {0, o, r0 + r});
  }
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
