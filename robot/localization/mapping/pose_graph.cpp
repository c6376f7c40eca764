#include "robot/localization/mapping/pose_graph.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr int kMaxIterations = 60;
constexpr double kLoopLoss = 2.0;  // sigmas beyond which a loop loses weight

/// One node as Ceres sees it.
struct Node {
  Eigen::Vector3d p;
  Eigen::Quaterniond q;
};

struct EdgeCost {
  Eigen::Vector3d p_from_to;
  Eigen::Quaterniond q_from_to;
  Eigen::Matrix<double, 6, 6> sqrt_information;

  template <class T>
  bool operator()(const T* p_a, const T* q_a, const T* p_b, const T* q_b, T* residual) const {
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> pa(p_a), pb(p_b);
    const Eigen::Map<const Eigen::Quaternion<T>> qa(q_a), qb(q_b);
    const Eigen::Quaternion<T> qa_inverse = qa.conjugate();
    Eigen::Map<Eigen::Matrix<T, 6, 1>> r(residual);
    r.template head<3>() = qa_inverse * (pb - pa) - p_from_to.cast<T>();
    const Eigen::Quaternion<T> dq = q_from_to.conjugate().cast<T>() * (qa_inverse * qb);
    r.template tail<3>() = T(2.0) * dq.vec() * (dq.w() < T(0.0) ? T(-1.0) : T(1.0));
    r.applyOnTheLeft(sqrt_information.cast<T>());
    return true;
  }
};

/// The square root of the information, or a zero matrix if there is none.
Eigen::Matrix<double, 6, 6> sqrtInformation(const Eigen::Matrix<double, 6, 6>& covariance) {
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> of_covariance(covariance);
  if (!covariance.allFinite() || of_covariance.info() != Eigen::Success)
    return Eigen::Matrix<double, 6, 6>::Zero();
  const Eigen::Matrix<double, 6, 6> L_inverse =
      of_covariance.matrixL().solve(Eigen::Matrix<double, 6, 6>::Identity());
  return L_inverse;  // C = L L^T, so |L^-1 r|^2 = r^T C^-1 r
}

Result<void> addEdge(const PoseEdge& edge, std::vector<Node>& nodes, ceres::Problem& problem) {
  const auto count = static_cast<int>(nodes.size());
  const Eigen::Matrix<double, 6, 6> root = sqrtInformation(edge.covariance);
  if (edge.from < 0 || edge.to < 0 || edge.from >= count || edge.to >= count ||
      edge.from == edge.to || root.isZero() || !isFinite(edge.X_from_to)) {
    return makeError(ErrorCode::InvalidInput,
                     "pose graph: the edge from {} to {} does not fit {} nodes or has no positive "
                     "definite covariance",
                     edge.from, edge.to, count);
  }
  auto* cost = new ceres::AutoDiffCostFunction<EdgeCost, 6, 3, 4, 3, 4>(new EdgeCost{
      edge.X_from_to.translation(), Eigen::Quaterniond(edge.X_from_to.linear()), root});
  Node& a = nodes[static_cast<std::size_t>(edge.from)];
  Node& b = nodes[static_cast<std::size_t>(edge.to)];
  problem.AddResidualBlock(cost,
                           edge.kind == EdgeKind::Loop ? new ceres::CauchyLoss(kLoopLoss) : nullptr,
                           a.p.data(), a.q.coeffs().data(), b.p.data(), b.q.coeffs().data());
  return {};
}

}  // namespace

Result<PoseGraphSolution> solvePoseGraph(const std::vector<Eigen::Isometry3d>& initial,
                                         const std::vector<PoseEdge>& edges) {
  PoseGraphSolution out;
  out.poses = initial;
  if (edges.empty()) return out;
  std::vector<Node> nodes;
  for (const Eigen::Isometry3d& X : initial)
    nodes.push_back({X.translation(), Eigen::Quaterniond(X.linear()).normalized()});
  ceres::Problem problem;
  for (const PoseEdge& edge : edges) {
    if (auto added = addEdge(edge, nodes, problem); !added)
      return tl::make_unexpected(added.error());
  }
  for (Node& node : nodes) {
    if (problem.HasParameterBlock(node.q.coeffs().data()))
      problem.SetManifold(node.q.coeffs().data(), new ceres::EigenQuaternionManifold);
  }
  if (problem.HasParameterBlock(nodes[0].p.data())) {
    problem.SetParameterBlockConstant(nodes[0].p.data());
    problem.SetParameterBlockConstant(nodes[0].q.coeffs().data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMaxIterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable())
    return makeError(ErrorCode::Degenerate, "pose graph: {}", summary.message);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    out.poses[i].translation() = nodes[i].p;
    out.poses[i].linear() = nodes[i].q.normalized().toRotationMatrix();
  }
  out.initial_cost = summary.initial_cost;
  out.final_cost = summary.final_cost;
  out.iterations = static_cast<int>(summary.iterations.size());
  return out;
}

EdgeResidual residualOf(const std::vector<Eigen::Isometry3d>& poses,
                        const std::vector<PoseEdge>& edges, EdgeKind kind) {
  EdgeResidual out;
  double metres2 = 0.0, radians2 = 0.0;
  for (const PoseEdge& edge : edges) {
    if (edge.kind != kind) continue;
    const Eigen::Isometry3d measured = poses[static_cast<std::size_t>(edge.from)].inverse() *
                                       poses[static_cast<std::size_t>(edge.to)];
    const Eigen::Isometry3d error = edge.X_from_to.inverse() * measured;
    ++out.edges;
    metres2 += error.translation().squaredNorm();
    radians2 += std::pow(rotationAngle(error), 2);
    out.worst_m = std::max(out.worst_m, error.translation().norm());
  }
  if (out.edges > 0) {
    out.rms_m = std::sqrt(metres2 / out.edges);
    out.rms_deg = std::sqrt(radians2 / out.edges) / kDeg;
  }
  return out;
}

}  // namespace kiln
