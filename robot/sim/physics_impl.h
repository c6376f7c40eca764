#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "robot/sim/physics.h"

struct mjModel_;
struct mjData_;
struct mjContact_;
using mjModel = mjModel_;
using mjData = mjData_;
using mjContact = mjContact_;

namespace kiln::sim {

/// What a geom of the model is.
struct GeomInfo {
  std::string name;
  bool robot = false, wheel = false, arm = false, floor = false, storage = false;
};

/// Bricks that stand in the storage, and where.
using Stored = std::vector<std::pair<std::size_t, Eigen::Isometry3d>>;  // X_base_brick

struct Physics::Impl {
  mjModel* m = nullptr;
  mjData* d = nullptr;
  std::vector<GeomInfo> geoms;
  int base_body = 0, flange_body = 0, obstacle_body = 0, obstacle_mocap = 0;
  int base_qpos = 0, base_qvel = 0;
  std::array<int, 4> steer_joint{}, drive_joint{};
  std::array<int, 6> arm_joint{}, arm_dof{};
  std::array<int, 4> steer_motor{}, drive_motor{};
  std::array<int, 6> arm_motor{};
  std::vector<int> compartment_joint, compartment_motor;
  std::vector<BodyContact> contacts;
  std::unique_ptr<BrickBodies> bricks;
  WallConfig wall;
  double carried_kg = 0.0;
  Eigen::Vector3d p_flange_carried = Eigen::Vector3d::Zero();

  ~Impl();
  void resolveNames();
  void placeBase(const Eigen::Isometry3d& X_map_base);
  [[nodiscard]] Eigen::Matrix<double, 6, 6> armInertia() const;
  [[nodiscard]] Vector6d carriedTorque(const Vector6d& qdd_radps2) const;
  void collectContacts();
  [[nodiscard]] bool planned(int a, int b, const BodyContact& contact) const;
  [[nodiscard]] bool holds(int geom) const;
  void noteBrickContact(const mjContact& c, const Eigen::Vector3d& force_on_2);
  void setObstacle(const Eigen::Vector3d& p_map);
  [[nodiscard]] Stored stored() const;
  void carryStored(const Stored& stored);
  [[nodiscard]] Eigen::Isometry3d poseOf(int body) const;
  [[nodiscard]] bool isObstacle(int geom) const;
  [[nodiscard]] JointState joint(int id) const;
};

}  // namespace kiln::sim
