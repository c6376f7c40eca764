#pragma once

#include <string>

#include "common/model/sensor.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/perception/cloud/arm_track.h"
#include "robot/perception/cloud/pose_track.h"

namespace kiln {

/// Puts every point of a scan where it was when it was measured: p_target = X_target_lidar(stamp +
/// time offset) * p_lidar. With a track of the LiDAR in `base` (or `map`, `odom`) the result is a
/// still picture in that frame.
/// @param scan            in `lidar`; NaN points stay NaN. Order, intensity, ring and times are
/// kept.
/// @param X_target_lidar  not empty; taken at 65 instants of the scan (1.6 ms at 10 Hz) and
/// interpolated between them at each point's own time.
/// @param target          frames.h word of the result.
[[nodiscard]] PointCloud undistort(const PointCloud& scan, const PoseTrack& X_target_lidar,
                                   const std::string& target);

/// X_base_lidar over a scan's duration, from the joint angles. Empty if the arm's track is.
[[nodiscard]] PoseTrack lidarInBase(const PointCloud& scan, const RobotGeometry& geometry,
                                    const ArmTrack& arm);

}  // namespace kiln
