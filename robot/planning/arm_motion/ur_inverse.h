#pragma once

#include <vector>

#include "common/robot_model/ur_kinematics.h"

namespace kiln {

/// Analytic inverse kinematics of a UR arm.
///
/// Up to eight solutions (shoulder left or right, elbow up or down, wrist flipped or not), each
/// joint in
/// [-pi, pi]. Where the wrist is singular (axes 4 and 6 parallel) joint 6 has no meaning of its own
/// and is taken from `reference`. Forward kinematics of each solution meets the pose to 1e-9 away
/// from singularities.
/// @param X_armbase_flange  wanted flange pose, finite.
/// @return empty if the pose is out of reach.
[[nodiscard]] std::vector<Vector6d> inverseSolutions(const UrKinematics& arm,
                                                     const Eigen::Isometry3d& X_armbase_flange,
                                                     const Vector6d& reference = Vector6d::Zero());

/// The same joint angles, each turned by whole turns to lie as near to `reference` as its limits
/// allow.
[[nodiscard]] Vector6d nearestTurn(const UrKinematics& arm, const Vector6d& q,
                                   const Vector6d& reference);

/// All whole-turn variants of q inside the joint limits, q itself included.
[[nodiscard]] std::vector<Vector6d> turnVariants(const UrKinematics& arm, const Vector6d& q);

[[nodiscard]] bool withinLimits(const UrKinematics& arm, const Vector6d& q,
                                double margin_rad = 0.0);

}  // namespace kiln
