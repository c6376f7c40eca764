#include "common/geom/camera_model.h"

#include <cmath>

namespace kiln {

CameraModel CameraModel::fromHorizontalFov(int width, int height, double hfov_rad) {
  const double f = 0.5 * width / std::tan(0.5 * hfov_rad);
  return {width, height, f, f, 0.5 * (width - 1), 0.5 * (height - 1)};
}

std::optional<Eigen::Vector2d> CameraModel::project(const Eigen::Vector3d& p_camera) const {
  if (!(p_camera.z() > 1e-9)) return std::nullopt;
  return Eigen::Vector2d(fx * p_camera.x() / p_camera.z() + cx,
                         fy * p_camera.y() / p_camera.z() + cy);
}

Eigen::Vector3d CameraModel::ray(const Eigen::Vector2d& pixel) const {
  return Eigen::Vector3d((pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1.0).normalized();
}

}  // namespace kiln
