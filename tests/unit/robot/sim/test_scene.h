#pragma once

#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "robot/sim/ray_scene.h"
#include "tests/support/kitchen.h"

namespace kiln::sim {

/// The nominal kitchen without any error, and a robot that can be put anywhere, also in the air.
struct TestScene {
  explicit TestScene(std::uint64_t seed = 1) {
    config.perturbation = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    EXPECT_TRUE(loadConfig(*resourcePath("robot_model/bob.yaml"), robot).has_value());
    arena = TrueArena::draw(config, map, site, robot, seed);
    state.q = RobotGeometry::radians(robot.q_drive_deg);
    scene = std::make_unique<RayScene>(config, arena, robot, false);
  }
  [[nodiscard]] const TrueFirePlace& fire() const { return arena.fire_places[arena.burning]; }
  /// Moves the whole robot so that a part fixed to its flange gets that pose.
  void putFlangePart(const Eigen::Isometry3d& X_flange_part, const Eigen::Isometry3d& X_map_part) {
    state.X_map_base = X_map_part * (robot.X_base_flange(state.q) * X_flange_part).inverse();
    scene->update(state);
  }
  /// Camera pose that looks at a point of the fire place from (range, bearing) off the plate's
  /// axis.
  [[nodiscard]] Eigen::Isometry3d lookAtPlate(double range_m, double bearing_rad) const {
    const Eigen::Vector3d axis = fire().X_map_front.linear().col(0);
    const Eigen::Vector3d from =
        fire().plateInMap() +
        range_m * (Eigen::AngleAxisd(bearing_rad, Eigen::Vector3d::UnitZ()) * axis);
    const Eigen::Vector3d z = (fire().plateInMap() - from).normalized();
    const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() << x, z.cross(x), z;
    X.translation() = from;
    return X;
  }

  WorldConfig config;
  ArenaMap map = loadKitchen();
  FireSiteMap site = loadKitchenSite();
  RobotGeometry robot;
  TrueArena arena;
  SceneState state;
  std::unique_ptr<RayScene> scene;
};

}  // namespace kiln::sim
