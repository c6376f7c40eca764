#include "robot/perception/bricks/brick_tilt.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr int kIterations = 10;
constexpr double kReach_m = 0.12;
constexpr double kFar_m = 0.08, kNear_m = 0.035;
constexpr double kPriorTurn_rad = 0.5, kPriorShift_m = 0.05;  // of one fit against the upright one

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

}  // namespace

FreeFit fitFreely(const PreparedSweep& sweep, const ModelBrick& brick,
                  const std::array<FaceGrid, 6>& lattice, double sigma_m) {
  FreeFit out;
  ModelBrick moving = brick;
  SurfaceAssignment points(sweep, {&brick, 1}, kReach_m);
  Matrix6 information = Matrix6::Zero();
  for (int k = 0; k < kIterations; ++k) {
    const double share = static_cast<double>(k) / (kIterations - 1);
    const CorrespondenceGates gates{kFar_m + share * (kNear_m - kFar_m), 0.01, 0.6};
    const auto found = points.assign({&moving, 1}, {&lattice, 1}, gates);
    Matrix6 H = Matrix6::Zero();
    Vector6 g = Vector6::Zero();
    out.weight = 0.0;
    const Eigen::Vector3d centre = moving.X_world_brick.translation();
    for (const Correspondence& c : found[0]) {
      Vector6 row;
      row << (c.p - centre).cross(c.n), c.n;
      H += c.weight * row * row.transpose();
      g += c.weight * row * c.n.dot(c.q - c.p);
      out.weight += c.weight;
    }
    information = H / (sigma_m * sigma_m);
    Matrix6 damped = information;
    damped.diagonal().head<3>().array() += 1.0 / (kPriorTurn_rad * kPriorTurn_rad);
    damped.diagonal().tail<3>().array() += 1.0 / (kPriorShift_m * kPriorShift_m);
    const Vector6 step = damped.ldlt().solve(g / (sigma_m * sigma_m));
    const double angle = step.head<3>().norm();
    if (angle > 0.0)
      moving.X_world_brick.linear() =
          Eigen::AngleAxisd(angle, step.head<3>() / angle).toRotationMatrix() *
          moving.X_world_brick.linear();
    moving.X_world_brick.translation() += step.tail<3>();
    information = damped;
  }
  out.X_level_brick = moving.X_world_brick;
  const Eigen::Vector3d up = moving.X_world_brick.linear().col(2);
  out.tilt_rad = std::acos(std::min(1.0, up.z()));
  const Matrix6 covariance = information.ldlt().solve(Matrix6::Identity());
  // About the axis that it leans around.
  const Eigen::Vector3d lean = Eigen::Vector3d::UnitZ().cross(up);
  if (lean.norm() > 1e-6) {
    const Eigen::Vector3d a = lean.normalized();
    out.tilt_sigma_rad = std::sqrt(a.dot(covariance.topLeftCorner<3, 3>() * a));
  }
  return out;
}

}  // namespace kiln
