#include "robot/perception/bricks/brick_blocks.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "common/core/check.h"

namespace kiln {

double BrickBlock::weightSum() const {
  double sum = 0.0;
  for (const Correspondence& c : correspondences) sum += c.weight;
  return std::max(sum, min_weight);
}

void BrickBlock::evaluate(const double* motion, double* residuals, double* jacobian) const {
  const double cos = std::cos(motion[0]), sin = std::sin(motion[0]);
  const Eigen::Vector3d t(motion[1], motion[2], motion[3]);
  const double scale = 1.0 / weightSum();
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const Correspondence& c = correspondences[i];
    const Eigen::Vector3d d = c.p - centre;
    const Eigen::Vector3d turned(cos * d.x() - sin * d.y(), sin * d.x() + cos * d.y(), d.z());
    const double root = std::sqrt(c.weight * scale);
    residuals[i] = root * c.n.dot(centre + turned + t - c.q);
    if (jacobian == nullptr) continue;
    double* const row = jacobian + 4 * i;
    row[0] = root * (-c.n.x() * turned.y() + c.n.y() * turned.x());  // d turned = z x turned
    for (int k = 0; k < 3; ++k) row[1 + k] = root * c.n[k];
  }
  const Eigen::Vector4d root(std::sqrt(hold.yaw), std::sqrt(hold.shift.x()),
                             std::sqrt(hold.shift.y()), std::sqrt(hold.shift.z()));
  const std::size_t first = correspondences.size();
  for (std::size_t k = 0; k < kHoldResiduals; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    residuals[first + k] = root[axis] * motion[k];
    if (jacobian == nullptr) continue;
    double* const row = jacobian + 4 * (first + k);
    std::fill_n(row, 4, 0.0);
    row[k] = root[axis];
  }
}

void PairBlock::evaluate(const double* motion_a, const double* motion_b, double* residuals,
                         double* jacobian_a, double* jacobian_b) const {
  const double half = 0.5 * (motion_a[0] - motion_b[0]);
  // |R(x) - I|_F^2 = 4 (1 - cos x) = 8 sin^2(x / 2)
  const double root_r = std::sqrt(8.0 * stiffness.yaw);
  residuals[0] = root_r * std::sin(half);
  const double cos = std::cos(motion_b[0]), sin = std::sin(motion_b[0]);
  const Eigen::Vector3d carried(cos * b_to_a.x() - sin * b_to_a.y(),
                                sin * b_to_a.x() + cos * b_to_a.y(), b_to_a.z());
  const Eigen::Vector3d root_t = stiffness.shift.cwiseSqrt();
  for (int k = 0; k < 3; ++k)
    residuals[1 + k] = root_t[k] * (b_to_a[k] + motion_a[1 + k] - motion_b[1 + k] - carried[k]);
  if (jacobian_a != nullptr) {
    std::fill_n(jacobian_a, 16, 0.0);
    jacobian_a[0] = 0.5 * root_r * std::cos(half);
    for (int k = 0; k < 3; ++k) jacobian_a[4 * (1 + k) + 1 + k] = root_t[k];
  }
  if (jacobian_b != nullptr) {
    std::fill_n(jacobian_b, 16, 0.0);
    jacobian_b[0] = -0.5 * root_r * std::cos(half);
    jacobian_b[4] = root_t[0] * carried.y();
    jacobian_b[8] = -root_t[1] * carried.x();
    for (int k = 0; k < 3; ++k) jacobian_b[4 * (1 + k) + 1 + k] = -root_t[k];
  }
}

std::vector<Eigen::Matrix4d> brickCovariances(std::span<const BrickBlock> blocks,
                                              std::span<const BrickPair> pairs,
                                              std::span<const UprightMotion> motions,
                                              double sigma_m, const Eigen::Vector4d& pair_sigmas,
                                              const Eigen::Vector4d& prior_sigmas) {
  KILN_CHECK(blocks.size() == motions.size(), blocks.size(), motions.size());
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  const auto n = static_cast<Eigen::Index>(blocks.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(4 * n, 4 * n);
  for (Eigen::Index b = 0; b < n; ++b) {
    const auto i = static_cast<std::size_t>(b);
    const BrickBlock& block = blocks[i];
    const auto rows = static_cast<Eigen::Index>(block.residuals());
    RowMajor jacobian(rows, 4);
    Eigen::VectorXd residuals(rows);
    block.evaluate(motions[i].data(), residuals.data(), jacobian.data());
    const auto measured = jacobian.topRows(rows - BrickBlock::kHoldResiduals);
    Eigen::Matrix4d own = measured.transpose() * measured;
    own *= block.weightSum() / (sigma_m * sigma_m);
    own.diagonal() += prior_sigmas.array().square().inverse().matrix();
    information.block<4, 4>(4 * b, 4 * b) += own;
  }
  for (const BrickPair& pair : pairs) {
    PairBlock unit = pair.block;
    unit.stiffness.yaw = 0.5 / (pair_sigmas[0] * pair_sigmas[0]);  // 8 / 4: see evaluate()
    unit.stiffness.shift = pair_sigmas.tail<3>().array().square().inverse();
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> A, B;
    Eigen::Vector4d residuals;
    unit.evaluate(motions[pair.a].data(), motions[pair.b].data(), residuals.data(), A.data(),
                  B.data());
    const auto a = static_cast<Eigen::Index>(4 * pair.a), b = static_cast<Eigen::Index>(4 * pair.b);
    information.block<4, 4>(a, a) += A.transpose() * A;
    information.block<4, 4>(b, b) += B.transpose() * B;
    information.block<4, 4>(a, b) += A.transpose() * B;
    information.block<4, 4>(b, a) += B.transpose() * A;
  }
  const Eigen::MatrixXd covariance =
      information.ldlt().solve(Eigen::MatrixXd::Identity(4 * n, 4 * n));
  std::vector<Eigen::Matrix4d> out;
  for (Eigen::Index b = 0; b < n; ++b) out.push_back(covariance.block<4, 4>(4 * b, 4 * b));
  return out;
}

}  // namespace kiln
