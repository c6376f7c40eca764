#pragma once

#include <memory>

#include "common/robot_model/robot_geometry.h"
#include "robot/app/state_history.h"
#include "robot/perception/cloud/pose_track.h"
#include "robot/perception/cloud/self_filter.h"

namespace kiln {

/// A scan as everything behind it uses it: without the robot itself, ranges corrected, each point
/// where it was when it was measured.
struct PreparedScan {
  PointCloudPtr cloud;  ///< in the base of the scan's stamp; in `lidar` if the motion is not known
  std::shared_ptr<const PoseTrack> X_base_lidar;  ///< over the scan; nullptr: not known
};

/// @param scan     in `lidar`.
/// @param history  joints and odometry over the scan. Thread-safe; so is this function.
[[nodiscard]] PreparedScan prepareScan(const PointCloud& scan, const RobotGeometry& robot,
                                       const StateHistory& history, const SelfFilter& self_filter);

/// When the scan's last point was measured.
[[nodiscard]] Stamp scanEnd(const PointCloud& scan);

}  // namespace kiln
