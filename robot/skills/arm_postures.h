#pragma once

#include <string>
#include <vector>

#include "common/robot_model/robot_geometry.h"
#include "robot/planning/arm_motion/arm_collision.h"

namespace kiln {

/// All postures that hold the flange there (base frame), nearest to `from` first, by the time that
/// the slowest joint needs. Empty: out of reach, or the pose is not a number.
[[nodiscard]] std::vector<Vector6d> posturesFor(const RobotGeometry& robot,
                                                const Eigen::Isometry3d& X_base_flange,
                                                const Vector6d& from);

/// Keeps the arm that clearance there? If not, and `what` is still empty, what is nearest goes into
/// it, in words.
[[nodiscard]] bool hasRoom(const ArmCollision& world, const Vector6d& q, double clearance_m,
                           std::string& what);

}  // namespace kiln
