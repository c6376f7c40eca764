#include "gui/views/scene3d/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace kiln::gui {
namespace {
constexpr double kTargetHeight = 0.6;       // about the deck: the arm stays in the picture
constexpr double kRadiansPerPixel = 0.006;  // half a turn over about 500 px
constexpr double kZoomPerNotch = 0.87;
constexpr double kLowest = 0.05, kHighest = 1.5;  // never below the ground, never over the pole
constexpr double kNearest = 1.0, kFarthest = 80.0;
}  // namespace

void OrbitCamera::reset(const Eigen::Vector3d& robot) {
  const OrbitCamera fresh;
  azimuth_ = fresh.azimuth_;
  elevation_ = fresh.elevation_;
  distance_ = fresh.distance_;
  target_ = {robot.x(), robot.y(), kTargetHeight};
}

void OrbitCamera::setMode(Mode mode) {
  mode_ = mode;
  centred_ = mode != Mode::Free;
}

void OrbitCamera::robotAt(const Eigen::Vector3d& robot) {
  if (centred_) target_ = {robot.x(), robot.y(), kTargetHeight};
}

void OrbitCamera::orbit(double dx_px, double dy_px, int height_px) {
  if (mode_ == Mode::Top) return pan(dx_px, dy_px, height_px);
  azimuth_ = std::remainder(azimuth_ - dx_px * kRadiansPerPixel, 2.0 * M_PI);
  elevation_ = std::clamp(elevation_ + dy_px * kRadiansPerPixel, kLowest, kHighest);
}

void OrbitCamera::pan(double dx_px, double dy_px, int height_px) {
  const double metres_per_pixel = 2.0 * halfHeight() / std::max(1, height_px);
  const Eigen::Vector3d view = (target_ - position()).normalized();
  const Eigen::Vector3d right = view.cross(up()).normalized();
  const Eigen::Vector3d screen_up = right.cross(view);
  if (mode_ == Mode::Follow) mode_ = Mode::Free;
  centred_ = false;
  target_ += metres_per_pixel * (-dx_px * right + dy_px * screen_up);
}

void OrbitCamera::lookAt(const Eigen::Vector3d& target, double distance) {
  if (mode_ == Mode::Follow) mode_ = Mode::Free;
  centred_ = false;
  target_ = target;
  distance_ = std::clamp(distance, kNearest, kFarthest);
}

void OrbitCamera::zoom(double notches) {
  distance_ = std::clamp(distance_ * std::pow(kZoomPerNotch, notches), kNearest, kFarthest);
}

Eigen::Vector3d OrbitCamera::position() const {
  if (mode_ == Mode::Top) return target_ + Eigen::Vector3d(0, 0, distance_);
  return target_ + distance_ * Eigen::Vector3d(std::cos(elevation_) * std::cos(azimuth_),
                                               std::cos(elevation_) * std::sin(azimuth_),
                                               std::sin(elevation_));
}

Eigen::Vector3d OrbitCamera::up() const {
  return mode_ == Mode::Top ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
}

double OrbitCamera::halfHeight() const { return distance_ * std::tan(0.5 * kFieldOfView); }

std::optional<Eigen::Vector2d> OrbitCamera::groundPoint(const Eigen::Vector2d& pixel, int width_px,
                                                        int height_px) const {
  constexpr double kReach_m = 200.0, kLeastSlope = 1e-3;
  if (width_px <= 0 || height_px <= 0) return std::nullopt;
  const Eigen::Vector3d view = (target_ - position()).normalized();
  const Eigen::Vector3d right = view.cross(up()).normalized();
  const Eigen::Vector3d screen_up = right.cross(view);
  const double half = parallel() ? halfHeight() : std::tan(0.5 * kFieldOfView);
  const double scale = 2.0 * half / height_px;
  const Eigen::Vector3d aside = scale * (pixel.x() - 0.5 * width_px) * right -
                                scale * (pixel.y() - 0.5 * height_px) * screen_up;
  const Eigen::Vector3d from = parallel() ? Eigen::Vector3d(position() + aside) : position();
  const Eigen::Vector3d ray = parallel() ? view : Eigen::Vector3d(view + aside);
  if (ray.z() > -kLeastSlope) return std::nullopt;
  const Eigen::Vector3d p = from - from.z() / ray.z() * ray;
  if ((p - from).norm() > kReach_m) return std::nullopt;
  return Eigen::Vector2d(p.x(), p.y());
}

std::optional<Eigen::Vector2d> OrbitCamera::project(const Eigen::Vector3d& p_map, int width_px,
                                                    int height_px) const {
  const Eigen::Vector3d view = (target_ - position()).normalized();
  const Eigen::Vector3d right = view.cross(up()).normalized();
  const Eigen::Vector3d screen_up = right.cross(view);
  const Eigen::Vector3d d = p_map - position();
  const double depth = d.dot(view);
  if (depth <= 0.05) return std::nullopt;
  const double half = parallel() ? halfHeight() : depth * std::tan(0.5 * kFieldOfView);
  const double scale = 0.5 * height_px / half;
  return Eigen::Vector2d(0.5 * width_px + scale * d.dot(right),
                         0.5 * height_px - scale * d.dot(screen_up));
}

}  // namespace kiln::gui
