#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "common/model/sensor.h"

namespace kiln {

/// A scan that goes into the map, with where the wheels believed to be.
struct Keyframe {
  PointCloud scan_base;                                     ///< undistorted, self-filtered, in base
  Pose2 X_odom_base;                                        ///< at scan_base.stamp
  Eigen::Vector3d p_base_sensor = Eigen::Vector3d::Zero();  ///< LiDAR centre, metres
  bool first_of_run = false;  ///< a new recording: odometry does not lead here
};

/// Points of the keyframe in `map`, for SurfelMap::insert.
[[nodiscard]] std::vector<Eigen::Vector3f> pointsInMap(const Keyframe& keyframe,
                                                       const Eigen::Isometry3d& X_map_base);

}  // namespace kiln
