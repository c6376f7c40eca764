#pragma once

#include <memory>
#include <random>

#include "common/geom/camera_model.h"
#include "common/model/sensor.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/evaluation/marker/marker_scene.h"

namespace kiln {

/// What the head camera makes of light, drawn by seed.
struct HeadCamera {
  double hfov_deg = kHeadCameraHfov_deg;
  double blur_px = 0.6;                               ///< sigma of the optics
  double exposure_stops = 0.0;                        ///< off what its automatic would choose
  Eigen::Vector3f balance = Eigen::Vector3f::Ones();  ///< gains of the white balance
  double noise = 0.006;                               ///< at mid grey, linear
  double shutter_s = 0.004;
  int jpeg_quality = 85;  ///< MJPG, 4:2:0
};

/// Draws scene and robot as the head camera sees them: rays (Embree), sun and sky with shadows of
/// things and of the robot itself, glare on the foil, optics and motion blur, exposure, noise, JPEG.
/// Independent of the simulator, so that neither can share the other's mistakes. About 0.5 s a
/// picture. Confined to one thread.
class MarkerPainter {
 public:
  MarkerPainter(const MarkerScene& scene, const RobotGeometry& robot, const HeadCamera& camera,
                std::uint64_t seed);
  ~MarkerPainter();
  /// @param X_map_rgb  true pose of the camera. @param q  joint angles, for the arm's shadow.
  /// @param turning_radps  rate of the camera about its own Y axis, for the motion blur.
  [[nodiscard]] RgbImage paint(const Eigen::Isometry3d& X_map_base, const Vector6d& q,
                               const Eigen::Isometry3d& X_map_rgb, double turning_radps);
  /// What a VLP-16 measures of ground and things (not of the robot), in `lidar`: 16 lasers, 0.4
  /// degrees apart, the front half. Range: bias of each laser and white noise of 10 mm, drop-outs of
  /// 0.5 %.
  [[nodiscard]] PointCloud scan(const Eigen::Isometry3d& X_map_lidar);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
