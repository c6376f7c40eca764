#pragma once

#include <string>
#include <vector>

#include "common/model/command.h"
#include "common/model/mission.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/control/arm_controller.h"
#include "robot/control/base_controller.h"
#include "robot/control/pump_controller.h"
#include "robot/planning/arm_motion/arm_collision.h"
#include "robot/scene/arena_map.h"

namespace kiln {

/// Turns accepted hold-to-run commands into setpoints. Every setpoint carries the time it was
/// received and lives 250 ms (pumps 200 ms): silence is a release, whatever happens to the sender.
/// Confined to the mission thread.
class Teleop {
 public:
  struct Config {
    double max_speed_mps = 1.0;
    double max_yaw_rate_radps = 0.6;
    double max_tool_speed_mps = 0.25;
    double max_tool_rate_radps = 0.6;
    double max_joint_rate_radps = 0.6;
    double guard_force_n = 50.0;
    double look_ahead_s = 0.3;  ///< a jog is judged by where the arm would be then
    double clearance_m = 0.03;  ///< nearer only when it leads away
    double damping = 0.05;      ///< of the Cartesian inverse near singularities
    void visit(ConfigArchive& a);
  };
  Teleop(Config config, const RobotGeometry& robot, const ArenaMap& arena, BaseController& base,
         ArmController& arm, PumpController& pumps);

  void setSpeedScale(double scale);
  [[nodiscard]] double speedScale() const { return speed_scale_; }
  void jogBase(const JogBase& jog, Stamp received, double link_scale);
  /// Stops before the robot's own body, itself, the ground and the known boxes of the arena.
  /// @param q  measured joints.
  void jogArm(const JogArm& jog, const Vector6d& q, const Pose2& X_map_base, Stamp received,
              double link_scale);
  /// Why the last arm jog did not move: "forearm is 2 cm from tank left"; empty if it did.
  [[nodiscard]] const std::string& blocked() const { return blocked_; }
  /// What can be held: the pumps, both or one.
  [[nodiscard]] static std::vector<ActuatorSpec> actuators();
  /// @pre one of actuators(), in its range.
  void holdActuator(const HoldActuator& hold, Stamp received);
  /// Explicit zero on everything that teleoperation moves.
  void releaseAll(Stamp now);

 private:
  [[nodiscard]] std::string objection(const Vector6d& q, const Vector6d& qd,
                                      const Pose2& X_map_base);
  [[nodiscard]] Vector6d jointRates(const JogArm& jog, const Vector6d& q, double scale) const;

  Config config_;
  const RobotGeometry& robot_;
  BaseController& base_;
  ArmController& arm_;
  PumpController& pumps_;
  ArmCollision collision_;
  const ArenaMap& arena_;  ///< asked anew for each jog: an operator may have moved a place in it
  std::string blocked_;
  double speed_scale_ = 0.35;
};

}  // namespace kiln
