#pragma once

#include <optional>

#include <Eigen/Core>

namespace kiln {

/// Of the head's camera, a Logitech Brio at 16:9: 78 deg across the diagonal.
inline constexpr double kHeadCameraHfov_deg = 70.4;

/// Pinhole camera. Pixel (0, 0) is the centre of the top-left pixel; camera axes X right, Y down, Z
/// viewing.
struct CameraModel {
  int width = 0;
  int height = 0;
  double fx = 0.0;  ///< pixels
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;

  /// Square pixels, centred principal point, from the horizontal field of view.
  [[nodiscard]] static CameraModel fromHorizontalFov(int width, int height, double hfov_rad);
  /// @return nullopt if the point is not in front of the camera. The pixel may lie outside the
  /// image.
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_camera) const;
  /// Unit viewing ray through a pixel, in the camera frame.
  [[nodiscard]] Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
};

}  // namespace kiln
