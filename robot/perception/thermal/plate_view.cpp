#include "robot/perception/thermal/plate_view.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kiln::thermal {
namespace {

constexpr std::size_t kArcCorners = 17;

/// A convex polygon without allocation: this runs thousands of times a fit.
struct Polygon {
  std::array<Eigen::Vector2d, 2 * kArcCorners> corners;
  std::size_t size = 0;
  void push(const Eigen::Vector2d& p) { corners[size++] = p; }
};

/// Appends the arc of a circle that lies within `half_angle` of `towards`, counter-clockwise, as
/// corners that enclose its sector's area.
void pushArc(Polygon& polygon, const Eigen::Vector2d& centre, double radius, double towards,
             double half_angle) {
  if (half_angle <= 0.0) return;
  const double step = 2.0 * half_angle / (kArcCorners - 1);
  const double enclosing = radius * std::sqrt(step / std::sin(step));
  for (std::size_t i = 0; i < kArcCorners; ++i) {
    const double angle = towards - half_angle + step * static_cast<double>(i);
    polygon.push(centre + enclosing * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
}

/// Half the angle of the circle of radius `r` that lies inside a circle of radius `other` whose
/// centre is `distance` away.
double halfAngleInside(double r, double other, double distance) {
  const double cosine = (distance * distance + r * r - other * other) / (2.0 * distance * r);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

std::optional<PlateObservation> viewPlate(const PlateModel& model, const CameraModel& camera,
                                          const Eigen::Isometry3d& X_camera_plate) {
  const Eigen::Vector3d eye =
      X_camera_plate.inverse().translation();  // the camera, in the plate frame
  if (!(eye.z() > model.recess_m + 0.01)) return std::nullopt;
  // The opening seen from the eye, projected on the plate's plane: a circle again.
  const double scale = eye.z() / (eye.z() - model.recess_m);
  const double plate = 0.5 * model.diameter_m, opening = 0.5 * model.opening_m * scale;
  const Eigen::Vector2d centre = eye.head<2>() * (1.0 - scale);
  const double distance = std::max(1e-9, centre.norm()),
               towards = std::atan2(centre.y(), centre.x());
  Polygon visible;
  if (distance < plate + opening) {
    pushArc(visible, Eigen::Vector2d::Zero(), plate, towards,
            halfAngleInside(plate, opening, distance));
    pushArc(visible, centre, opening, towards + M_PI, halfAngleInside(opening, plate, distance));
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
