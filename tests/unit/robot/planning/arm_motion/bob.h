#pragma once

#include <gtest/gtest.h>

#include "common/config/config_archive.h"
#include "robot/scene/obstacles.h"
#include "tests/support/kitchen.h"
#include "tests/support/paths.h"

namespace kiln {

/// The robot as the shipped file describes it.
inline RobotGeometry loadBob() {
  RobotGeometry robot;
  const auto loaded = loadConfig(kiln::sourceDir() + "/resources/robot_model/bob.yaml", robot);
  EXPECT_TRUE(loaded.has_value()) << loaded.error();
  return robot;
}
inline std::vector<BoxConfig> kitchenBoxes(const ArenaMap& arena) { return obstacles(arena); }
/// Flange pose in base at which the thermal camera stands at p and looks along base X, upright.
inline Eigen::Isometry3d flangeForCamera(const RobotGeometry& robot,
                                         const Eigen::Vector3d& p_base) {
  Eigen::Isometry3d X_base_thermal = Eigen::Isometry3d::Identity();
  X_base_thermal.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  X_base_thermal.translation() = p_base;
  return X_base_thermal * robot.X_flange_thermal.pose().inverse();
}

}  // namespace kiln
