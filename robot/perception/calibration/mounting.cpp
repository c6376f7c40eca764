#include "robot/perception/calibration/mounting.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <ceres/ceres.h>

namespace kiln {

double secondTurn(std::span<const Eigen::Isometry3d> X_base_flange) {
  Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
  for (const Eigen::Isometry3d& X : X_base_flange) {
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(X_base_flange.front().linear().transpose() * X.linear()));
    const Eigen::Vector3d w = turn.angle() * turn.axis();
    C += w * w.transpose();
  }
  C /= static_cast<double>(X_base_flange.size());
  return std::sqrt(
      std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(C).eigenvalues()[1]));
}

Result<void> solveMounting(ceres::Problem& problem, const std::string& part) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 100;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (summary.IsSolutionUsable()) return {};
  return makeError(ErrorCode::Degenerate, "the {}'s mounting did not converge: {}", part,
                   summary.BriefReport());
}

void takeSigmas(ceres::Problem& problem, const double* mount, Extrinsics& out) {
  ceres::Covariance covariance{ceres::Covariance::Options()};
  const std::vector<std::pair<const double*, const double*>> wanted{{mount, mount}};
  if (!covariance.Compute(wanted, &problem)) return;
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> C;
  covariance.GetCovarianceBlock(mount, mount, C.data());
  out.sigma_rad = C.diagonal().head<3>().cwiseSqrt();
  out.sigma_m = C.diagonal().tail<3>().cwiseSqrt();
}

}  // namespace kiln
