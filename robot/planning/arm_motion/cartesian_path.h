#pragma once

#include <vector>

#include "common/core/error.h"
#include "robot/planning/arm_motion/arm_collision.h"
#include "robot/planning/arm_motion/joint_trajectory.h"

namespace kiln {

struct CartesianPathConfig {
  double step_m = 0.005;             ///< spacing of the inverse kinematics
  double rotation_weight_m = 0.25;   ///< 1 rad of turning counts as this much way
  double blend_radius_m = 0.04;      ///< way before and after a corner that is rounded
  double max_joint_step_rad = 0.25;  ///< more between two samples: the line leaves its branch
  double clearance_m = 0.03;         ///< set by MoveArm, not from the file
  void visit(ConfigArchive& a);
};

/// Joint paths that lead the flange along straight lines through the poses, orientation turning
/// evenly.
/// @param q_start          present joints; the first line starts at their pose.
/// @param X_base_flange    at least one pose in base.
/// @param blend            one path with rounded corners; else one path a line, with a stop at each
/// pose.
/// @return Error{Degenerate} where a line cannot be reached or turns too fast (singularity),
/// Error{Refused} where it
///         comes too near to something: the sentence says what and where. An arm that starts too
///         near may retreat.
[[nodiscard]] Result<std::vector<JointPath>> cartesianPaths(
    const RobotGeometry& robot, const ArmCollision& collision, const CartesianPathConfig& config,
    const Vector6d& q_start, const std::vector<Eigen::Isometry3d>& X_base_flange, bool blend);

/// How many of the poses are behind when a share of the way from `X_from` through all of them is
/// covered. The last pose is never behind.
[[nodiscard]] std::size_t posesBehind(const CartesianPathConfig& config,
                                      const Eigen::Isometry3d& X_from,
                                      const std::vector<Eigen::Isometry3d>& X_base_flange,
                                      double covered);

/// Flange pose at which something mounted on the flange (nozzle, camera) has the wanted pose.
[[nodiscard]] inline Eigen::Isometry3d flangeFor(const Eigen::Isometry3d& X_base_mounted,
                                                 const Eigen::Isometry3d& X_flange_mounted) {
  return X_base_mounted * X_flange_mounted.inverse();
}

}  // namespace kiln
