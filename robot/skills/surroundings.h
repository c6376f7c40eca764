#pragma once

#include "common/geom/pose.h"
#include "common/model/obstacle_cloud.h"

namespace kiln {

/// What the live cloud says of the world around the robot, as skills see it. An
/// interface, because perception works behind it (robot/app). Confined to the mission thread.
class Surroundings {
 public:
  virtual ~Surroundings() = default;
  /// What stands around, without ground and robot; nullptr before the first scans.
  [[nodiscard]] virtual ObstacleCloudPtr obstacles() const = 0;
  /// Wheel odometry now, to place obstacles(): p_base = X_odom_base^-1 * p_odom.
  [[nodiscard]] virtual Pose2 X_odom_base() const = 0;
};

}  // namespace kiln
