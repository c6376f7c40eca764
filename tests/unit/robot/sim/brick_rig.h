#pragma once

#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "robot/sim/arm_device.h"
#include "robot/sim/base_device.h"
#include "robot/sim/collision_monitor.h"
#include "robot/sim/gripper_device.h"
#include "robot/sim/physics.h"
#include "robot/sim/storage_device.h"

namespace kiln::sim {

/// Mario among the bricks of the lab test: physics and devices alone, without sensors. The bricks
/// lie where the test puts them.
struct BrickRig {
  explicit BrickRig(WorldConfig c = quiet(), std::uint64_t seed = 1) : config(std::move(c)) {
    EXPECT_TRUE(loadConfig(*resourcePath(config.robot), robot).has_value());
    ArenaMap map;
    EXPECT_TRUE(loadConfig(*resourcePath(config.arena), map).has_value());
    arena = TrueArena::draw(config, map, {}, robot, seed);
    const auto added = arena.addWall(config, *loadWallSite(map), seed);
    EXPECT_TRUE(added.has_value()) << added.error();
    physics = std::move(*Physics::create(config, arena, robot));
    arm = std::make_unique<ArmDevice>(config.arm, robot, arena.robot, seed);
    base = std::make_unique<BaseDevice>(config.base, robot, arena.robot, seed);
    gripper = std::make_unique<GripperDevice>(config.wall.magnets, seed);
    storage = std::make_unique<StorageDevice>(config.wall.storage, robot.storage, seed);
    q = RobotGeometry::radians(robot.q_drive_deg);  // the face of the magnets looks down
    physics->carryTo(arena.ground.standing({0, 0, 0}, robot), q);
    arm->reset(now, q);
  }
  /// The lab's world as its file says, nothing off its nominal size or place.
  static WorldConfig quiet() {
    WorldConfig config = *WorldConfig::load(*resourcePath("worlds/wall_lab.yaml"));
    config.perturbation = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    config.arm.force_noise_n = config.arm.torque_noise_nm = 0.0;
    config.arm.force_offset_n = config.arm.force_drift_n = 0.0;
    config.arm.head_off_kg = config.arm.head_off_m = 0.0;
    WallConfig& w = config.wall;
    w.site_m = w.site_deg = w.stack_m = w.stack_deg = w.brick_m = w.brick_deg = w.plate_m = 0.0;
    return config;
  }

  [[nodiscard]] BrickBodies& bricks() { return *physics->bricks(); }
  [[nodiscard]] double dt() const { return config.physics.step_s; }
  void step() {
    arm->control(now, dt(), *physics);
    base->control(now, dt(), *physics);
    gripper->step(dt());
    bricks().setFields(gripper->fields());
    storage->control(now, dt(), *physics);
    physics->step();
    now += fromSeconds(dt());
    arm->sense(now, dt(), *physics);
    collisions.observe(now, physics->contacts());
  }
  void run(double seconds) {
    for (const Stamp end = now + fromSeconds(seconds); now < end;) step();
  }
  void magnets(bool on) { gripper->write(on ? MagnetMask().set() : MagnetMask()); }
  [[nodiscard]] Eigen::Isometry3d X_map_tool() const {
    return physics->X_map_base() * robot.X_base_flange(physics->armPosition()) *
           robot.X_flange_tool.pose();
  }
  /// Puts a brick before the face: its upper side at `gap_m`, its middle so far off along X of both.
  void hang(std::size_t brick, double gap_m, double off_m = 0.0) {
    Eigen::Isometry3d X_tool_brick = Eigen::Isometry3d::Identity();
    X_tool_brick.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
    X_tool_brick.translation() = Eigen::Vector3d(off_m, 0, 0.5 * kBrickSide_m + gap_m);
    bricks().place(brick, X_map_tool() * X_tool_brick);
  }
  /// First brick of that kind. @pre there is one
  [[nodiscard]] std::size_t first(BrickKind kind) const {
    for (std::size_t i = 0; i < arena.wall.bricks.size(); ++i)
      if (arena.wall.bricks[i].kind == kind) return i;
    return 0;
  }
  [[nodiscard]] double height(std::size_t brick) {
    return bricks().state(brick).X_map_brick.translation().z();
  }
  /// Moves the arm there on a straight line in the joints. @return how long it took, s
  void moveTo(const Vector6d& goal, double seconds) {
    const Vector6d from = q;
    for (double t = 0.0; t < seconds;) {
      t = std::min(seconds, t + dt());
      const double s = t / seconds, p = s * s * (3 - 2 * s), v = 6 * s * (1 - s) / seconds;
      q = from + p * (goal - from);
      EXPECT_EQ(arm->servo(now, q, v * (goal - from)), "");
      step();
    }
  }
  /// Joints that bring the tool there, near the ones it has. @pre reachable
  [[nodiscard]] Vector6d reach(const Eigen::Isometry3d& X_base_tool) const {
    Vector6d out = q;
    for (int i = 0; i < 200; ++i) {
      const auto error = [&](const Vector6d& at) {
        const Eigen::Isometry3d X = robot.X_base_flange(at) * robot.X_flange_tool.pose();
        const Eigen::AngleAxisd turn(X.linear().transpose() * X_base_tool.linear());
        Vector6d e;
        e << X_base_tool.translation() - X.translation(), X.linear() * (turn.angle() * turn.axis());
        return e;
      };
      const Vector6d e = error(out);
      if (e.norm() < 1e-9) break;
      Eigen::Matrix<double, 6, 6> J;
      for (int j = 0; j < 6; ++j) {
        Vector6d moved = out;
        moved[j] += 1e-6;
        J.col(j) = (e - error(moved)) / 1e-6;
      }
      const Eigen::Matrix<double, 6, 6> normal =
          J.transpose() * J + 1e-8 * Eigen::Matrix<double, 6, 6>::Identity();
      Vector6d step = normal.ldlt().solve(J.transpose() * e);
      out += step * std::min(1.0, 0.3 / step.norm());
    }
    return out;
  }

  WorldConfig config;
  RobotGeometry robot;
  TrueArena arena;
  std::unique_ptr<Physics> physics;
  std::unique_ptr<ArmDevice> arm;
  std::unique_ptr<BaseDevice> base;
  std::unique_ptr<GripperDevice> gripper;
  std::unique_ptr<StorageDevice> storage;
  CollisionMonitor collisions{5.0};
  Stamp now;
  Vector6d q;
};

}  // namespace kiln::sim
