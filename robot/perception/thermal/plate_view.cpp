#include "robot/perception/thermal/plate_view.h"

#include <array>
#include <cmath>

namespace kiln::thermal {
namespace {

constexpr std::size_t kCorners = 28;  // of the polygon that stands for the disc

/// A convex polygon without allocation: this runs thousands of times a fit. Each clip adds at most
/// one corner.
struct Polygon {
  std::array<Eigen::Vector2d, kCorners + 8> corners;
  std::size_t size = 0;
  void push(const Eigen::Vector2d& p) { corners[size++] = p; }
};

/// Corners of a polygon that has the area of the unit disc.
const std::array<Eigen::Vector2d, kCorners>& unitDisc() {
  static const auto disc = [] {
    std::array<Eigen::Vector2d, kCorners> out;
    const double step = 2 * M_PI / kCorners;
    const double radius = std::sqrt(step / std::sin(step));
    for (std::size_t i = 0; i < kCorners; ++i) {
      const double angle = step * static_cast<double>(i);
      out[i] = radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    return out;
  }();
  return disc;
}

/// Keeps the part where sign * p[axis] <= limit (Sutherland and Hodgman).
Polygon clip(const Polygon& in, int axis, double sign, double limit) {
  Polygon out;
  for (std::size_t i = 0; i < in.size; ++i) {
    const Eigen::Vector2d& a = in.corners[i];
    const Eigen::Vector2d& b = in.corners[i + 1 < in.size ? i + 1 : 0];
    const double da = sign * a[axis] - limit, db = sign * b[axis] - limit;
    if (da <= 0) out.push(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) out.push(a + (b - a) * (da / (da - db)));
  }
  return out;
}

}  // namespace

std::optional<PlateObservation> viewPlate(const PlateModel& model, const CameraModel& camera,
                                          const Eigen::Isometry3d& X_camera_plate) {
  const Eigen::Vector3d eye =
      X_camera_plate.inverse().translation();  // the camera, in the plate frame
  if (!(eye.z() > model.recess_m + 0.01)) return std::nullopt;
  Polygon visible;
  for (const auto& p : unitDisc()) visible.push(0.5 * model.diameter_m * p);
  // The opening seen from the eye, projected on the plate's plane: a square again.
  const double scale = eye.z() / (eye.z() - model.recess_m);
  const double half = 0.5 * model.opening_m * scale;
  for (int axis = 0; axis < 2; ++axis) {
    const double centre = eye[axis] * (1.0 - scale);
    visible = clip(visible, axis, 1.0, half + centre);
    visible = clip(visible, axis, -1.0, half - centre);
  }
  if (visible.size < 3) return std::nullopt;
  for (std::size_t i = 0; i < visible.size; ++i) {
    Eigen::Vector2d& p = visible.corners[i];
    const auto pixel = camera.project(X_camera_plate * Eigen::Vector3d(p.x(), p.y(), 0));
    if (!pixel) return std::nullopt;
    p = *pixel;
  }
  double twice_area = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  const Eigen::Vector2d& first = visible.corners[0];
  for (std::size_t i = 1; i + 1 < visible.size; ++i) {
    const Eigen::Vector2d a = visible.corners[i] - first, b = visible.corners[i + 1] - first;
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice_area += cross;
    moment += cross * (a + b);
  }
  if (std::abs(twice_area) < 1e-6) return std::nullopt;
  const double blur = M_PI * model.psf_sigma_px * model.psf_sigma_px;
  const double area = 0.5 * std::abs(twice_area) - blur;
  if (!(area > 0)) return std::nullopt;
  return PlateObservation{first + moment / (3 * twice_area), area};
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
