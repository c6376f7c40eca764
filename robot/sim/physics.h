#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "robot/sim/brick_bodies.h"
#include "robot/sim/true_arena.h"

namespace kiln::sim {

struct JointState {
  double position = 0.0;  ///< rad, m
  double velocity = 0.0;  ///< rad/s, m/s
};

/// One touching pair of bodies in one step, contact points summed.
struct BodyContact {
  std::string a, b;      ///< geom names, a on the robot or what it holds; arena names without index
  bool wheel = false;    ///< a is a wheel
  bool floor = false;    ///< b is the floor
  bool arm = false;      ///< a belongs to arm, head or hose (and b is not of the arm)
  bool planned = false;  ///< a grasp, a placement, or a brick in its bin: no collision
  double normal_n = 0.0;
  Eigen::Vector3d force_on_a = Eigen::Vector3d::Zero();  ///< N in map
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       ///< mean contact point in map
};

/// MuJoCo behind plain values: the robot on its wheels among the arena's boxes. One step is
/// PhysicsConfig::step_s. A MuJoCo error or an unstable step ends the process with a message (exit
/// status 3): the world would be meaningless. Thread-compatible.
class Physics {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Physics>> create(const WorldConfig& config,
                                                               const TrueArena& arena,
                                                               const RobotGeometry& robot);
  ~Physics();

  void step();
  /// Puts the robot at rest there, with what it has stored; what it holds is taken from it and
  /// stays where it was. The rest of the world stays as it is.
  void carryTo(const Eigen::Isometry3d& X_map_base, const Vector6d& q);
  /// Puts the robot there as it is: joints, wheels and its velocities (in base) stay.
  void displace(const Eigen::Isometry3d& X_map_base);
  /// The arena's first box of that name.
  void moveBox(const std::string& name, const Eigen::Isometry3d& X_map_box);
  /// Puts the centre of the scripted arm obstacle there.
  /// @return false: it would touch the robot, and stays away.
  bool placeObstacle(const Eigen::Vector3d& p_map);
  void removeObstacle();

  void setSteerTorque(std::size_t wheel, double torque_nm);
  void setDriveTorque(std::size_t wheel, double torque_nm);
  /// Of the robot's compartments, N along their travel.
  void setCompartmentForce(std::size_t compartment, double force_n);
  /// What the arm's controller was told that hangs beyond the head: its weight and inertia are
  /// carried by the torques too. Mass 0: nothing.
  void setCarried(double mass_kg, const Eigen::Vector3d& p_flange_com);
  /// Joint torques that give the arm this acceleration against gravity and its own inertia, cut at
  /// the limits.
  /// @return the unlimited torques.
  Vector6d accelerateArm(const Vector6d& qdd_radps2);

  [[nodiscard]] JointState steer(std::size_t wheel) const;
  [[nodiscard]] JointState drive(std::size_t wheel) const;
  [[nodiscard]] Vector6d armPosition() const;
  [[nodiscard]] Vector6d armVelocity() const;
  [[nodiscard]] Eigen::Isometry3d X_map_base() const;
  /// Linear velocity (map) of a point fixed to the flange.
  [[nodiscard]] Eigen::Vector3d flangePointVelocity(const Eigen::Vector3d& p_map) const;
  [[nodiscard]] const std::vector<BodyContact>& contacts() const;
  /// Along its travel: position m, velocity m/s.
  [[nodiscard]] JointState compartment(std::size_t compartment) const;
  [[nodiscard]] std::vector<double> compartmentPositions() const;
  /// nullptr: this world has no bricks.
  [[nodiscard]] BrickBodies* bricks();
  [[nodiscard]] const BrickBodies* bricks() const;

 private:
  struct Impl;
  explicit Physics(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln::sim
