#include "robot/planning/arm_motion/shapes.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

constexpr int kSearchSteps = 22;  // golden section: 0.618^22 = 2.5e-5 of a segment below 1 m
constexpr double kGolden = 0.6180339887498949;

/// Half the extent of a box along a unit axis.
double extent(const OrientedBox& box, const Eigen::Vector3d& axis) {
  return (box.X_frame_box.linear().transpose() * axis).cwiseAbs().dot(box.half);
}

}  // namespace

OrientedBox makeBox(const Eigen::Isometry3d& X_frame_box, const Eigen::Vector3d& size,
                    std::string name) {
  return {X_frame_box, 0.5 * size, 0.5 * size.norm(), std::move(name)};
}

double signedDistance(const Eigen::Vector3d& p_box, const Eigen::Vector3d& half) {
  const Eigen::Vector3d excess = p_box.cwiseAbs() - half;
  return excess.cwiseMax(0.0).norm() + std::min(0.0, excess.maxCoeff());
}

double distance(const Capsule& capsule, const OrientedBox& box) {
  const Eigen::Isometry3d X_box_frame = box.X_frame_box.inverse();
  const Eigen::Vector3d a = X_box_frame * capsule.a;
  const Eigen::Vector3d along = X_box_frame * capsule.b - a;
  // The signed distance to a convex body is convex, so along a segment it has one minimum.
  const auto at = [&](double t) { return signedDistance(a + t * along, box.half); };
  double low = 0.0, high = 1.0;
  double t1 = high - kGolden, t2 = low + kGolden;
  double d1 = at(t1), d2 = at(t2);
  for (int i = 0; i < kSearchSteps; ++i) {
    if (d1 < d2) {
      high = t2;
      t2 = t1;
      d2 = d1;
      t1 = high - kGolden * (high - low);
      d1 = at(t1);
    } else {
      low = t1;
      t1 = t2;
      d1 = d2;
      t2 = low + kGolden * (high - low);
      d2 = at(t2);
    }
  }
  return std::min({d1, d2, at(0.0), at(1.0)}) - capsule.radius;
}

double distance(const Capsule& first, const Capsule& second) {
  const Eigen::Vector3d u = first.b - first.a, v = second.b - second.a, w = first.a - second.a;
  const double a = u.squaredNorm(), c = v.squaredNorm(), b = u.dot(v);
  const double d = u.dot(w), e = v.dot(w);
  const double det = a * c - b * b;
  // Nearest points of the two lines, then clamped to the segments one after the other.
  double s = det > 1e-12 ? std::clamp((b * e - c * d) / det, 0.0, 1.0) : 0.0;
  double t = c > 1e-12 ? (b * s + e) / c : 0.0;
  if (t < 0.0 || t > 1.0) {
    t = std::clamp(t, 0.0, 1.0);
    s = a > 1e-12 ? std::clamp((b * t - d) / a, 0.0, 1.0) : 0.0;
  }
  return (w + s * u - t * v).norm() - first.radius - second.radius;
}

double separation(const OrientedBox& first, const OrientedBox& second) {
  const Eigen::Vector3d between =
      second.X_frame_box.translation() - first.X_frame_box.translation();
  const Eigen::Matrix3d A = first.X_frame_box.linear(), B = second.X_frame_box.linear();
  double widest = -INFINITY;
  const auto test = [&](const Eigen::Vector3d& axis) {
    const double gap = std::abs(between.dot(axis)) - extent(first, axis) - extent(second, axis);
    widest = std::max(widest, gap);
  };
  for (int i = 0; i < 3; ++i) {
    test(A.col(i));
    test(B.col(i));
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d edge = A.col(i).cross(B.col(j));
      const double length = edge.norm();
      if (length > 1e-6) test(edge / length);
    }
  }
  return widest;
}

}  // namespace kiln
