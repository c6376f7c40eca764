#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "common/core/mutex.h"
#include "common/core/stamp.h"
#include "common/geom/pose.h"

namespace kiln {

/// Joint angles and odometry at one instant.
struct RobotSample {
  Stamp stamp;
  Vector6d q = Vector6d::Zero();
  Pose2 X_odom_base;
};

/// The last seconds of joint angles and odometry, so that a sensor frame can be placed where the
/// sensor was when it was taken. Arm and wheels report at instants of their own and are
/// interpolated each by its own stamps. Written by the control thread, read by perception jobs;
/// thread-safe.
class StateHistory {
 public:
  explicit StateHistory(Duration span = std::chrono::seconds(3)) : span_(span) {}
  /// What is not newer than the last one is ignored.
  void addJoints(Stamp stamp, const Vector6d& q);
  void addOdometry(Stamp stamp, const Pose2& X_odom_base);
  /// Linear interpolation. Ahead of the newest report the motion goes on as it was for 10 ms (a
  /// scan's last points are often newer than the last joint state) and is then held, up to 50 ms;
  /// nullopt outside of either.
  [[nodiscard]] std::optional<RobotSample> at(Stamp stamp) const;
  void clear();

 private:
  Duration span_;
  mutable Mutex mutex_;
  std::deque<std::pair<Stamp, Vector6d>> joints_;
  std::deque<std::pair<Stamp, Pose2>> odometry_;
};

}  // namespace kiln
