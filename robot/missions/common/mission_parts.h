#pragma once

#include <functional>
#include <optional>

#include "common/core/clock.h"
#include "common/core/executor.h"
#include "common/model/mission.h"
#include "common/model/sensor.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/control/arm_controller.h"
#include "robot/control/pump_controller.h"
#include "robot/hal/arm.h"
#include "robot/hal/gripper.h"
#include "robot/hal/storage.h"
#include "robot/perception/cloud/scan_window.h"
#include "robot/scene/arena_map.h"
#include "robot/skills/motion.h"
#include "robot/world_model/robot_belief.h"

namespace kiln {

/// Where base and head were at one instant.
struct BodyPose {
  Pose2 X_odom_base;  ///< wheel odometry: smooth, drifts
  Pose2 X_map_base;   ///< the same by the newest localisation
  Eigen::Isometry3d X_base_flange = Eigen::Isometry3d::Identity();
};

/// What the robot lends a mission; all of it outlives the mission.
struct MissionParts {
  const Clock& clock;
  Executor& executor;
  ArenaMap& arena;  ///< what everybody plans with; a mission may move what stands elsewhere
  const RobotGeometry& robot;
  const RobotBelief& belief;
  BaseMotion& base;       ///< DriveTo
  ArmMotion& arm;         ///< MoveArm
  const Arm& arm_device;  ///< joints and safety mode
  PumpController& pumps;
  std::function<Pose2()> pose;  ///< newest X_map_base
  /// Prepared scans of the last seconds, oldest first.
  std::function<std::deque<ScanWindow::Entry>()> scans;
  /// Where the flange was in map at a stamp of the last seconds; nullopt: not known.
  std::function<std::optional<Eigen::Isometry3d>(Stamp)> X_map_flange;
  /// Both at a stamp of the last seconds; nullopt: not known. Any thread but for X_map_base, which is
  /// that of the last tick.
  std::function<std::optional<BodyPose>(Stamp)> body_at;
  /// To the stations and the recording.
  std::function<void(ThermalImagePtr)> publish_thermal;
  std::function<void(MissionDetail)> publish_detail;  ///< on the mission stream
  /// What only some robots have; a mission that needs it says so in its line of the catalogue.
  ArmController* arm_control = nullptr;  ///< payload and force of the arm that `arm` moves
  Gripper* gripper = nullptr;
  Storage* storage = nullptr;
};

}  // namespace kiln
