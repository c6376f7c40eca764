// Torques of the arm.
#include <mujoco/mujoco.h>

#include "robot/sim/physics_impl.h"

namespace kiln::sim {

/// The arm's part of the mass matrix, full.
Eigen::Matrix<double, 6, 6> Physics::Impl::armInertia() const {
  Eigen::Matrix<double, 6, 6> M = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 0; i < 6; ++i) {
    int at = m->dof_Madr[arm_dof[static_cast<std::size_t>(i)]];
    for (int dof = arm_dof[static_cast<std::size_t>(i)]; dof >= 0; dof = m->dof_parentid[dof], ++at)
      for (int j = 0; j < 6; ++j)
        if (arm_dof[static_cast<std::size_t>(j)] == dof) M(i, j) = M(j, i) = d->qM[at];
  }
  return M;
}

/// Torques for the point mass that the controller was told of.
Vector6d Physics::Impl::carriedTorque(const Vector6d& qdd) const {
  if (carried_kg <= 0.0) return Vector6d::Zero();
  const Eigen::Isometry3d X = poseOf(flange_body);
  const Eigen::Vector3d p = X * p_flange_carried;
  std::vector<mjtNum> jacobian(3 * static_cast<std::size_t>(m->nv));
  mj_jac(m, d, jacobian.data(), nullptr, p.data(), flange_body);
  Eigen::Matrix<double, 3, 6> J;
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 3; ++k)
      J(k, i) =
          jacobian[static_cast<std::size_t>(k * m->nv + arm_dof[static_cast<std::size_t>(i)])];
  const Eigen::Vector3d up(0, 0, 9.81);
  return J.transpose() * (carried_kg * (J * qdd + up));
}

Vector6d Physics::accelerateArm(const Vector6d& qdd) {
  mjData* d = impl_->d;
  const Eigen::Matrix<double, 6, 6> M = impl_->armInertia();
  const Vector6d carried = impl_->carriedTorque(qdd);
  Vector6d torque;
  for (Eigen::Index i = 0; i < 6; ++i) {
    double sum = d->qfrc_bias[impl_->arm_dof[static_cast<std::size_t>(i)]];
    for (Eigen::Index j = 0; j < 6; ++j) sum += M(i, j) * qdd[j];
    sum += carried[i];
    torque[i] = sum;
    d->ctrl[impl_->arm_motor[static_cast<std::size_t>(i)]] = sum;
  }
  return torque;
}

}  // namespace kiln::sim
