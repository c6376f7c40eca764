#pragma once

#include <array>

#include "robot/evaluation/bricks/brick_scene.h"
#include "robot/perception/bricks/brick_sweep.h"
#include "robot/scene/raycaster.h"

namespace kiln {

/// The LiDAR of scenario.md section 2, and a sweep of the arm: the sensor tilts down at a constant
/// rate for at most 5 s.
struct SweepSensor {
  int columns = 1800;
  double rate_hz = 10.0;
  double bias_sigma_m = 0.01;  ///< a laser, fixed by seed; not calibrated away
  double noise_sigma_m = 0.01;
  double footprint_mrad = 3.0;
  double mixing_depth_m = 0.6;
  double dropout = 0.005;
  double min_range_m = 0.4, max_range_m = 100.0;
  double sector_deg = 80.0;  ///< each side of ahead; the rest of a turn sees nothing of a target
  double sweep_s = 4.5;
  double tilt_from_deg = 2.0, tilt_to_deg = 40.0;  ///< downwards
  double height_m = 1.6, ahead_m = 0.8;            ///< of the LiDAR in base at the beginning
  double lever_m = 0.15;                           ///< of the LiDAR above the axis of the tilt
  /// What a calibration leaves of the mounting's error (benchmarks.md: 0.6 mm, 0.03 deg).
  double mount_sigma_m = 0.0006, mount_sigma_deg = 0.03;
  double rounding_m = 0.005;  ///< of the bricks' edges
};

/// A thing that is no brick.
struct ClutterBox {
  Eigen::Isometry3d X_world_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
};

/// Makes the sweep that a robot would measure. Draws laser biases and mounting error at its
/// construction. Confined to one thread.
class SweepSynthesis {
 public:
  SweepSynthesis(const SweepSensor& sensor, SceneRandom& random);
  [[nodiscard]] BrickSweep sweep(const BrickScene& scene, const Eigen::Isometry3d& X_world_base,
                                 std::span<const ClutterBox> clutter = {});

 private:
  static constexpr std::size_t kLasers = 16;
  [[nodiscard]] Eigen::Isometry3d X_base_lidar(double t_s) const;
  [[nodiscard]] Eigen::Vector3f direction(int column, std::size_t laser, double turn,
                                          double tilt) const;
  void scan(int number, const Raycaster& rays, const Eigen::Isometry3d& X_world_base,
            BrickSweep& out);
  void mixEdges(const Raycaster& rays, const std::vector<Eigen::Matrix3f>& R, int first_column);

  SweepSensor sensor_;
  SceneRandom& random_;
  Eigen::Isometry3d mount_error_ = Eigen::Isometry3d::Identity();
  std::array<double, kLasers> bias_m_{};
  std::vector<Raycaster::Ray> rays_;
  std::vector<Raycaster::Hit> hits_;
};

}  // namespace kiln
