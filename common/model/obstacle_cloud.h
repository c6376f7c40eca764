#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/core/stamp.h"

namespace kiln {

/// What stands around the robot, remembered over some seconds of scans: without the ground, without
/// the robot itself. Frame: odom as a plane; z as it was measured above the plane of the wheels.
struct ObstacleCloud {
  struct Point {
    Eigen::Vector3f p_odom;  ///< metres
    float height_m = 0.0f;   ///< above the local ground, also on a slope
  };
  Stamp stamp;  ///< of the newest scan
  std::vector<Point> points;
};
using ObstacleCloudPtr = std::shared_ptr<const ObstacleCloud>;

}  // namespace kiln
