// The robot is put elsewhere.
#include <algorithm>
#include <cmath>

#include <mujoco/mujoco.h>

#include "robot/sim/physics_impl.h"

namespace kiln::sim {

/// Half a millimetre above the ground, so that no contact begins deep inside it.
void Physics::Impl::placeBase(const Eigen::Isometry3d& X) {
  const Eigen::Vector3d p = X * Eigen::Vector3d(0, 0, 0.0005);
  const Eigen::Quaterniond r(X.linear());
  mjtNum* base = d->qpos + base_qpos;
  const double pose[7] = {p.x(), p.y(), p.z(), r.w(), r.x(), r.y(), r.z()};
  std::copy(pose, pose + 7, base);
}

/// Stored is what lies over a compartment's floor, or leans out of it.
Stored Physics::Impl::stored() const {
  Stored out;
  if (!bricks) return out;
  const Eigen::Isometry3d X_map_base = poseOf(base_body);
  for (std::size_t i = 0; i < bricks->size(); ++i) {
    if (bricks->grip().held == i) continue;
    const Eigen::Isometry3d X = X_map_base.inverse() * bricks->state(i).X_map_brick;
    for (const int joint : compartment_joint) {
      const Eigen::Isometry3d X_map_row = poseOf(m->jnt_bodyid[joint]);
      const Eigen::Vector3d p = X_map_row.inverse() * X_map_base * X.translation();
      if (p.x() < -0.1 || p.x() > 0.4 || std::fabs(p.y()) > 0.8 || p.z() < 0.0 || p.z() > 2.0)
        continue;
      out.emplace_back(i, X);
      break;
    }
  }
  return out;
}

void Physics::Impl::carryStored(const Stored& stored) {
  if (stored.empty()) return;
  for (const auto& [brick, X_base_brick] : stored)
    bricks->place(brick, poseOf(base_body) * X_base_brick);
}

void Physics::carryTo(const Eigen::Isometry3d& X, const Vector6d& q) {
  mjModel* m = impl_->m;
  mjData* d = impl_->d;
  const Eigen::Vector3d obstacle(d->mocap_pos + 3 * impl_->obstacle_mocap);
  const double time = d->time;
  const Stored stored = impl_->stored();
  const std::vector<double> bricks = impl_->bricks ? impl_->bricks->save() : std::vector<double>{};
  const std::vector<double> compartments = compartmentPositions();
  if (impl_->bricks) impl_->bricks->letGo();
  mj_resetData(m, d);
  d->time = time;
  if (impl_->bricks) impl_->bricks->restore(bricks);
  for (std::size_t i = 0; i < compartments.size(); ++i)
    d->qpos[m->jnt_qposadr[impl_->compartment_joint[i]]] = compartments[i];
  impl_->setObstacle(obstacle);
  impl_->placeBase(X);
  for (std::size_t i = 0; i < 6; ++i)
    d->qpos[m->jnt_qposadr[impl_->arm_joint[i]]] = q[static_cast<Eigen::Index>(i)];
  impl_->contacts.clear();
  mj_step1(m, d);
  impl_->carryStored(stored);
}

void Physics::displace(const Eigen::Isometry3d& X) {
  mjtNum* v = impl_->d->qvel + impl_->base_qvel;  // linear in map, angular in base
  const Eigen::Vector3d turned =
      X.linear() * (X_map_base().linear().transpose() * Eigen::Vector3d(v[0], v[1], v[2]));
  const Stored stored = impl_->stored();
  std::copy(turned.data(), turned.data() + 3, v);
  impl_->placeBase(X);
  impl_->contacts.clear();
  mj_step1(impl_->m, impl_->d);
  impl_->carryStored(stored);
}

}  // namespace kiln::sim
