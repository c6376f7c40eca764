#pragma once

#include <vector>

#include "common/robot_model/robot_geometry.h"

namespace kiln {

/// A point of an edge of the robot, and a second one beside it along the edge; in base.
struct EdgePoint {
  Eigen::Vector3d p, along;
};

/// Edges of deck, tanks and head that a camera on the robot sees: of faces turned to it, and not
/// behind another part. The arm's links hide with a margin: joints, hose and shadows beside them
/// are not in the model.
/// @param q         joint angles, rad.
/// @param sample_m  between two points of an edge; half of that on the head, which is small.
[[nodiscard]] std::vector<EdgePoint> visibleEdges(const RobotGeometry& robot, const Vector6d& q,
                                                  const Eigen::Vector3d& p_base_camera,
                                                  double sample_m);

}  // namespace kiln
