#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/model/sensor.h"
#include "common/record/foxglove.h"
#include "common/robot_model/robot_geometry.h"

namespace kiln {

/// What the tree of frames (common/geom/frames.h) is made of at one instant.
struct FrameSources {
  Stamp stamp;
  const RobotGeometry& robot;
  std::optional<Vector6d> q;         ///< measured joints; nullopt: the arm does not report
  std::optional<Pose2> X_odom_base;  ///< nullopt: no wheel odometry
  std::optional<Eigen::Isometry3d> X_map_base;  ///< on the ground as it slopes; nullopt: not known
};

/// Every edge that is known: map -> odom -> base -> {arm_base, operator_camera, flange}, flange ->
/// {lidar, thermal, rgb, nozzle, tool}. A mounting that no file states, and a pose that is not
/// finite, is not an edge: a default taken for a measurement disconnected the paper's tree
/// unnoticed. Odometry is planar, so the slope stands in map -> odom.
[[nodiscard]] std::vector<foxglove::FrameTransform> frameTree(const FrameSources& sources);

/// Edges of the full tree that are not there, "flange -> lidar", in the order of the tree.
[[nodiscard]] std::vector<std::string> missingEdges(std::span<const foxglove::FrameTransform> tree);

/// How many edges the full tree has.
[[nodiscard]] int fullTreeSize();

}  // namespace kiln
