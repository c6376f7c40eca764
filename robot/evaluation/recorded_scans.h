#pragma once

#include <functional>
#include <string>

#include "common/model/sensor.h"
#include "common/robot_model/robot_geometry.h"

namespace kiln {

/// A LiDAR scan of a recording as localisation and mapping take it.
struct RecordedScan {
  PointCloud scan_base;                                     ///< undistorted, without the robot
  Pose2 X_odom_base;                                        ///< wheel odometry at scan_base.stamp
  Eigen::Vector3d p_base_sensor = Eigen::Vector3d::Zero();  ///< LiDAR centre, metres
  std::uint32_t resets = 0;  ///< counts up when the robot was carried and its odometry began anew
};

struct RecordedScanCount {
  int scans = 0;
  int without_motion = 0;  ///< left out: no arm or odometry around the scan
  int damaged = 0;         ///< left out: messages that cannot be read
};

/// Goes through a recording of kiln-robotd and prepares every scan as the daemon does: the robot is
/// taken out, the points are undistorted with odometry and arm motion.
/// Error: as RecordReader::open; what `sink` returns ends it.
[[nodiscard]] Result<RecordedScanCount> forEachScan(
    const std::string& path, const RobotGeometry& robot,
    const std::function<Result<void>(RecordedScan)>& sink);

}  // namespace kiln
