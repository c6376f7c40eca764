#include "robot/missions/fire/skills/pose_step.h"

#include <algorithm>

namespace kiln {

Eigen::Isometry3d poseStep(const Eigen::Isometry3d& X_now, const Eigen::Isometry3d& X_goal,
                           double max_step_m, double max_turn_rad) {
  const double way = (X_goal.translation() - X_now.translation()).norm();
  const double turn = rotationAngle(X_now.inverse() * X_goal);
  const double steps = std::max(way / max_step_m, turn / max_turn_rad);
  return steps <= 1.0 ? X_goal : interpolate(X_now, X_goal, 1.0 / steps);
}

bool atPose(const Eigen::Isometry3d& X_now, const Eigen::Isometry3d& X_goal, double position_m,
            double angle_rad) {
  return (X_goal.translation() - X_now.translation()).norm() <= position_m &&
         rotationAngle(X_now.inverse() * X_goal) <= angle_rad;
}

}  // namespace kiln
