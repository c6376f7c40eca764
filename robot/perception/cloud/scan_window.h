#pragma once

#include <deque>
#include <memory>

#include "common/config/config_archive.h"
#include "common/model/sensor.h"
#include "robot/perception/cloud/pose_track.h"

namespace kiln {

/// The last scans, so that slow questions (where does the fire box stand?) are answered from more
/// than one picture. A scan is kept for long when base or LiDAR had moved since the one kept
/// before, so that a robot at rest does not fill the window with the same rays. Confined to one
/// thread; the clouds are shared, not copied.
class ScanWindow {
 public:
  struct Config {
    int max_scans = 40;
    double max_age_s = 25.0;  ///< people walk, furniture is moved
    double step_m = 0.05;     ///< LiDAR or base moved so far: a new view
    double step_deg = 2.0;    ///< or turned so far
    int newest = 6;           ///< so many of the newest are kept whether or not they are new views
    void visit(ConfigArchive& a);
  };
  /// One scan, prepared (undistorted, self-filtered), in `base` at its stamp.
  struct Entry {
    PointCloudPtr scan_base;
    Eigen::Isometry3d X_map_base;    ///< believed, at the scan's stamp
    Eigen::Isometry3d X_base_lidar;  ///< at the scan's stamp
    /// X_base_lidar while the scan was taken, in the base of its stamp; nullptr: not kept.
    std::shared_ptr<const PoseTrack> lidar_track{};
    Pose2 X_odom_base{};  ///< wheel odometry at the stamp: has the base stood still since?
  };
  explicit ScanWindow(Config config) : config_(config) {}
  /// Ignores a scan that is older than the newest, or whose pose is not finite.
  void add(Entry entry);
  void clear() { entries_.clear(); }  ///< after a reset: the poses no longer fit
  [[nodiscard]] const std::deque<Entry>& entries() const { return entries_; }

 private:
  [[nodiscard]] bool newView(const Entry& before, const Entry& after) const;
  Config config_;
  std::deque<Entry> entries_;
};

}  // namespace kiln
