#pragma once

#include "robot/app/absent_devices.h"
#include "robot/app/devices.h"
#include "robot/app/robot.h"
#include "robot/control/arm_controller.h"
#include "robot/control/base_controller.h"
#include "robot/control/pump_controller.h"
#include "robot/skills/drive_to.h"
#include "robot/skills/move_arm.h"
#include "robot/world_model/robot_belief.h"

namespace kiln {

/// Everything of one robot that moves, whoever commands it: devices, controllers, skills, and what
/// they plan with. The parts of the robot (sensor intake, localization, mission, operator desk,
/// reporting) work on it. tick() belongs to the control thread, the skills to the mission thread.
struct RobotBody {
  /// @param pose_in  newest X_map_base, asked from the mission thread.
  RobotBody(const RobotSettings& settings_in, const RobotOptions& options_in, Devices devices_in,
            const Clock& clock_in, StopLatch& stop_in, RobotGeometry robot_in, ArenaMap arena_in,
            const std::function<Pose2()>& pose_in)
      : settings(settings_in),
        options(options_in),
        devices(std::move(devices_in)),
        pump_device(devices.pumps != nullptr ? *devices.pumps : absent.pumps),
        clock(clock_in),
        stop(stop_in),
        robot(std::move(robot_in)),
        arena(std::move(arena_in)),
        pose(pose_in),
        base(settings.base, robot, devices.base, stop),
        arm(settings.arm, robot, devices.arm, stop),
        pumps(settings.pumps, pump_device, stop),
        drive(settings.drive_to, robot, arena, base, pose),
        move_arm(settings.move_arm, robot, arena, arm, devices.arm, pose) {
    belief.X_map_base = arena.start.pose();
  }
  void tick(Stamp now) {
    base.tick(now);
    arm.tick(now);
    pumps.tick(now);
  }

  const RobotSettings settings;
  const RobotOptions options;
  const Devices devices;
  AbsentDevices absent;
  Pumps& pump_device;  ///< silent on a robot without pumps
  const Clock& clock;
  StopLatch& stop;
  const RobotGeometry robot;
  ArenaMap arena;
  const std::function<Pose2()> pose;
  std::shared_ptr<const Geofence> fence;  ///< of `base`; set before anything runs
  BaseController base;
  ArmController arm;
  PumpController pumps;
  DriveTo drive;
  MoveArm move_arm;
  RobotBelief belief;
};

[[nodiscard]] inline std::optional<Vector6d> joints(const std::optional<ArmState>& arm) {
  return arm ? std::optional(arm->q) : std::nullopt;
}

/// Seconds since `stamp`; nullopt if it never was.
[[nodiscard]] inline std::optional<double> ageOf(const std::optional<Stamp>& stamp, Stamp now) {
  return stamp ? std::optional(toSeconds(now - *stamp)) : std::nullopt;
}

}  // namespace kiln
