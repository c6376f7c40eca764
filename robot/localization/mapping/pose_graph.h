#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "common/core/error.h"
#include "common/geom/pose.h"

namespace kiln {

enum class EdgeKind { Odometry, Registration, Loop };

/// A measured pose of node `to` in node `from`.
struct PoseEdge {
  int from = 0, to = 0;
  EdgeKind kind = EdgeKind::Odometry;
  Eigen::Isometry3d X_from_to = Eigen::Isometry3d::Identity();
  /// Of (x y z m, rotation vector rad) in `from`; positive definite.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
};

struct EdgeResidual {
  int edges = 0;
  double rms_m = 0.0, rms_deg = 0.0, worst_m = 0.0;
};

struct PoseGraphSolution {
  std::vector<Eigen::Isometry3d> poses;  ///< as the nodes, the first one unmoved
  double initial_cost = 0.0, final_cost = 0.0;
  int iterations = 0;
};

/// Least squares over all edges (Ceres, sparse Cholesky, one thread: the same input gives the same
/// bits). Loop edges are robust (Cauchy): a false one must not bend the map.
/// @param initial  poses of the nodes in some common frame.
/// @return Error{InvalidInput} if an edge names no node or has no positive definite covariance;
///         Error{Degenerate} if the solver gives up.
[[nodiscard]] Result<PoseGraphSolution> solvePoseGraph(
    const std::vector<Eigen::Isometry3d>& initial, const std::vector<PoseEdge>& edges);

/// How far `poses` are from what the edges of one kind measured.
[[nodiscard]] EdgeResidual residualOf(const std::vector<Eigen::Isometry3d>& poses,
                                      const std::vector<PoseEdge>& edges, EdgeKind kind);

}  // namespace kiln
