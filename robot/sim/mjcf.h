#pragma once

#include <string>

#include "robot/sim/true_arena.h"

namespace kiln::sim {

/// Each side of the scripted arm obstacle (arm_obstacle.h), for physics and rays.
inline constexpr double kObstacleSize_m = 0.2;

/// Names shared by the model text and the code that reads results.
namespace names {
inline constexpr const char* kBase = "base";
inline constexpr const char* kFlange = "flange";
inline constexpr const char* kObstacle = "obstacle";
inline constexpr const char* kWheel[4] = {"wheel front left", "wheel front right",
                                          "wheel rear left", "wheel rear right"};
inline constexpr const char* kSteer[4] = {"steer_fl", "steer_fr", "steer_rl", "steer_rr"};
inline constexpr const char* kDrive[4] = {"drive_fl", "drive_fr", "drive_rl", "drive_rr"};
inline constexpr const char* kJoint[6] = {"shoulder_pan", "shoulder_lift", "elbow",
                                          "wrist_1",      "wrist_2",       "wrist_3"};
}  // namespace names

/// The MuJoCo model (MJCF) of one drawn world: ground, arena boxes, robot with four steered hub
/// wheels and a UR10e. Link masses, centres of mass and inertias are the vendor's. The robot's
/// bodies collide as boxes, its arm as arm_hull.h; only the wheels are meant to touch anything.
[[nodiscard]] std::string mjcf(const WorldConfig& config, const TrueArena& arena,
                               const RobotGeometry& robot);

}  // namespace kiln::sim
