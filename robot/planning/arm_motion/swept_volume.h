#pragma once

#include <optional>
#include <span>
#include <string>

#include "common/config/config_archive.h"
#include "robot/planning/arm_motion/arm_collision.h"
#include "robot/planning/arm_motion/joint_trajectory.h"
#include "robot/planning/arm_motion/point_grid.h"

namespace kiln {

struct SweptVolumeConfig {
  double clearance_m = 0.03;  ///< a point nearer to arm or head than this is in the way
  int min_points = 4;         ///< fewer are noise
  double gather_m = 0.12;     ///< points in the way count together within this
  double step_m = 0.03;       ///< between two postures that are looked at; no part moves farther
  void visit(ConfigArchive& a);
};

/// What stands in the way of a joint path.
struct SweptHit {
  std::string part;                                  ///< "forearm"
  Eigen::Vector3d p_base = Eigen::Vector3d::Zero();  ///< the middle of what is in the way
  double path_share = 0.0;                           ///< 0..1: how far the arm would get
  int points = 0;
};

/// Is there anything in the live cloud where the arm would pass? Configured boxes are the planner's
/// business; this sees what really stands there. Points that touch the arm before it moves are its
/// own (hose, mixed pixels at its edge) and are left out.
/// @param paths   in order; base at rest.
/// @param points  in base.
[[nodiscard]] std::optional<SweptHit> firstInSweptVolume(const ArmCollision& arm,
                                                         std::span<const JointPath> paths,
                                                         const PointGrid& points,
                                                         const SweptVolumeConfig& config);

}  // namespace kiln
