#pragma once

#include "robot/perception/cloud/obstacle_memory.h"
#include "robot/perception/cloud/scan_window.h"
#include "robot/skills/surroundings.h"

namespace kiln {

/// The live cloud as skills and missions see it: remembers obstacles, and keeps a window of scans
/// for slow questions. Confined to the mission thread.
class LiveSurroundings final : public Surroundings {
 public:
  struct Config {
    ObstacleMemory::Config obstacles;
    ScanWindow::Config window;
    void visit(ConfigArchive& a);
  };
  explicit LiveSurroundings(const Config& config);

  /// A prepared scan with where base and LiDAR were at its stamp.
  struct Scan {
    PointCloudPtr scan_base;
    ObstacleScan obstacles;  ///< made by ObstacleMemory::observe on the pool
    Pose2 X_odom_base;
    Eigen::Isometry3d X_map_base;
    std::shared_ptr<const PoseTrack> lidar_track{};  ///< over the scan
  };
  void add(const Scan& scan);
  /// Once a tick.
  void tick(const Pose2& X_odom_base_now) { X_odom_base_ = X_odom_base_now; }
  /// The robot was carried to its start: nothing that was seen fits any more.
  void clear();

  [[nodiscard]] ObstacleCloudPtr obstacles() const override { return memory_.snapshot(); }
  [[nodiscard]] Pose2 X_odom_base() const override { return X_odom_base_; }
  /// Prepared scans of the last seconds, oldest first.
  [[nodiscard]] const std::deque<ScanWindow::Entry>& scans() const { return window_.entries(); }

 private:
  ObstacleMemory memory_;
  ScanWindow window_;
  Pose2 X_odom_base_;
};

}  // namespace kiln
