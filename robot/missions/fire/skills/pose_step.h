#pragma once

#include "common/geom/pose.h"

namespace kiln {

/// The next pose on the way from X_now to X_goal, at most `max_step_m` and `max_turn_rad` away;
/// X_goal itself when it is that near. The paper aims in steps of 10 cm so that each takes in new
/// measurements (section "Challenge 3").
[[nodiscard]] Eigen::Isometry3d poseStep(const Eigen::Isometry3d& X_now,
                                         const Eigen::Isometry3d& X_goal, double max_step_m,
                                         double max_turn_rad);

/// True when `X_now` differs from `X_goal` by at most these.
[[nodiscard]] bool atPose(const Eigen::Isometry3d& X_now, const Eigen::Isometry3d& X_goal,
                          double position_m, double angle_rad);

}  // namespace kiln
