#pragma once

#include <vector>

#include "common/core/error.h"
#include "robot/planning/arm_motion/arm_collision.h"

namespace kiln {

/// Where the LiDAR is held for a sweep, and from which tilt to which it turns about its own centre.
/// In base: X of the LiDAR looks along `yaw_rad`, then down by the tilt.
struct LidarView {
  Eigen::Vector3d p_base = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  double tilt_from_rad = 0.0, tilt_to_rad = 0.0;  ///< positive: downwards
  [[nodiscard]] Eigen::Isometry3d X_base_lidar(double tilt_rad) const;
  [[nodiscard]] double middle() const { return 0.5 * (tilt_from_rad + tilt_to_rad); }
  [[nodiscard]] double span() const { return tilt_to_rad - tilt_from_rad; }
};

/// A sweep as the arm makes it: to `q_from` by any way, then straight in joint space to `q_to`.
struct SweepMotion {
  Vector6d q_from = Vector6d::Zero(), q_to = Vector6d::Zero();
  double duration_s = 4.2;  ///< of the straight motion
};

struct SweepMotionLimits {
  double clearance_m = 0.04;   ///< along the whole straight motion; no less than MoveArm's
  double speed_scale = 0.25;   ///< of the joint limits; MoveArm must not need longer than planned
  double max_step_rad = 0.35;  ///< of a joint within 4 deg of tilt; more: near a singularity
};

/// Joints that carry the LiDAR through a view: inverse kinematics at the middle of the tilt, nearest
/// to `q_near` first, followed on the same branch to both ends.
/// @param world  the robot among its surroundings.
/// @return Error{Degenerate}: no posture reaches it; Error{Refused}: each that does comes too near
///         to something, or turns too fast; the sentence says what.
[[nodiscard]] Result<SweepMotion> sweepMotion(const RobotGeometry& robot, const ArmCollision& world,
                                              const LidarView& view, const Vector6d& q_near,
                                              double duration_s, const SweepMotionLimits& limits);

/// X_base_lidar at `count` evenly spaced shares of the motion, both ends included. @pre count >= 2
[[nodiscard]] std::vector<Eigen::Isometry3d> lidarPoses(const RobotGeometry& robot,
                                                        const SweepMotion& motion, int count);

/// The view of a first look: from the posture for driving, whatever stands where, the LiDAR tilted
/// through the span. It turns all around meanwhile: what lies ahead is seen densely.
[[nodiscard]] LidarView firstLook(const RobotGeometry& robot, double tilt_from_rad,
                                  double tilt_to_rad);

}  // namespace kiln
