#pragma once

#include <functional>
#include <memory>
#include <random>

#include "robot/perception/cloud/scan_window.h"
#include "robot/perception/cloud/self_filter.h"
#include "robot/perception/cloud/undistort.h"
#include "robot/sim/lidar_sensor.h"
#include "tests/support/kitchen.h"

namespace kiln {

/// The simulator's LiDAR in the true kitchen of a seed, on a robot that moves as a test says: makes
/// the scans that the robot would prepare with its nominal geometry.
class ScanRig {
 public:
  struct Motion {
    Pose2 X_map_base;
    Vector6d q;
  };
  explicit ScanRig(std::uint64_t seed, bool perturbed = true);
  /// Raw scan that begins at or after `t_s`, with the robot moving as `motion` says by time.
  [[nodiscard]] PointCloudPtr scan(double t_s, const std::function<Motion(double)>& motion);
  /// Joint angles and LiDAR poses over a scan as the robot measures them, every 8 ms.
  struct Tracks {
    ArmTrack arm;
    PoseTrack X_base0_lidar;  ///< in the base frame of the scan's first point
  };
  [[nodiscard]] Tracks tracksOf(const PointCloud& scan,
                                const std::function<Motion(double)>& motion) const;
  /// Scan without robot and distortion, in base at its stamp.
  [[nodiscard]] PointCloud prepare(const PointCloud& scan,
                                   const std::function<Motion(double)>& motion) const;

  sim::WorldConfig config;
  ArenaMap map = loadKitchen();
  FireSiteMap site = loadKitchenSite();
  RobotGeometry robot;
  sim::TrueArena arena;
  std::unique_ptr<sim::RayScene> scene;
  std::unique_ptr<sim::LidarSensor> lidar;
};

}  // namespace kiln
