#include "robot/perception/thermal/plate_view.h"

#include <array>
#include <cmath>
#include <vector>

namespace kiln::thermal {
namespace {

constexpr int kCorners = 40;  // of the polygon that stands for the disc

using Polygon = std::vector<Eigen::Vector2d>;

/// Polygon of the same area as the disc.
const Polygon& unitDisc() {
  static const Polygon disc = [] {
    Polygon out;
    const double step = 2 * M_PI / kCorners;
    const double radius = std::sqrt(step / std::sin(step));
    for (int i = 0; i < kCorners; ++i) {
      out.emplace_back(radius * std::cos(i * step), radius * std::sin(i * step));
    }
    return out;
  }();
  return disc;
}

/// Keeps the part where sign * p[axis] <= limit (Sutherland and Hodgman).
Polygon clip(const Polygon& in, int axis, double sign, double limit) {
  Polygon out;
  out.reserve(in.size() + 2);
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Eigen::Vector2d& a = in[i];
    const Eigen::Vector2d& b = in[(i + 1) % in.size()];
    const double da = sign * a[axis] - limit, db = sign * b[axis] - limit;
    if (da <= 0) out.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) out.push_back(a + (b - a) * (da / (da - db)));
  }
  return out;
}

}  // namespace

std::optional<PlateObservation> viewPlate(const PlateModel& model, const CameraModel& camera,
                                          const Eigen::Isometry3d& X_camera_plate) {
  const Eigen::Vector3d eye =
      X_camera_plate.inverse().translation();  // the camera, in the plate frame
  if (!(eye.z() > model.recess_m + 0.01)) return std::nullopt;
  Polygon visible = unitDisc();
  for (auto& p : visible) p *= 0.5 * model.diameter_m;
  // The opening seen from the eye, projected on the plate's plane: a square again.
  const double scale = eye.z() / (eye.z() - model.recess_m);
  const double half = 0.5 * model.opening_m * scale;
  for (int axis = 0; axis < 2; ++axis) {
    const double centre = eye[axis] * (1.0 - scale);
    visible = clip(visible, axis, 1.0, half + centre);
    visible = clip(visible, axis, -1.0, half - centre);
  }
  if (visible.size() < 3) return std::nullopt;
  for (auto& p : visible) {
    const auto pixel = camera.project(X_camera_plate * Eigen::Vector3d(p.x(), p.y(), 0));
    if (!pixel) return std::nullopt;
    p = *pixel;
  }
  double twice_area = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const Eigen::Vector2d a = visible[i] - visible[0],
                          b = visible[(i + 1) % visible.size()] - visible[0];
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice_area += cross;
    moment += cross * (a + b);
  }
  if (std::abs(twice_area) < 1e-6) return std::nullopt;
  const double blur = M_PI * model.psf_sigma_px * model.psf_sigma_px;
  const double area = 0.5 * std::abs(twice_area) - blur;
  if (!(area > 0)) return std::nullopt;
  return PlateObservation{visible[0] + moment / (3 * twice_area), area};
}

Eigen::Isometry3d platePose(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d z = normal.normalized();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitZ().cross(z).normalized();
  X.linear().col(0) = x;
  X.linear().col(1) = z.cross(x);
  X.linear().col(2) = z;
  X.translation() = p;
  return X;
}

}  // namespace kiln::thermal
