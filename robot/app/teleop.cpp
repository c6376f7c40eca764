#include "robot/app/teleop.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "robot/scene/obstacles.h"

namespace kiln {
namespace {

double unit(double value) { return std::clamp(value, -1.0, 1.0); }

/// Shortens `v` to at most `limit`, keeping its direction.
Eigen::Vector3d limited(const Eigen::Vector3d& v, double limit) {
  const double norm = v.norm();
  return norm > limit ? Eigen::Vector3d(v * (limit / norm)) : v;
}

}  // namespace

void Teleop::Config::visit(ConfigArchive& a) {
  a.field("max_speed_mps", max_speed_mps, "m/s", 0, 4, "base speed at full stick and scale 1");
  a.field("max_yaw_rate_radps", max_yaw_rate_radps, "rad/s", 0, 3, "base turn rate at full stick");
  a.field("max_tool_speed_mps", max_tool_speed_mps, "m/s", 0, 1, "tool speed");
  a.field("max_tool_rate_radps", max_tool_rate_radps, "rad/s", 0, 2, "tool turn rate");
  a.field("max_joint_rate_radps", max_joint_rate_radps, "rad/s", 0, 3, "joint speed in a jog");
  a.field("guard_force_n", guard_force_n, "N", 5, 150, "an arm jog stops at this contact force");
  a.field("look_ahead_s", look_ahead_s, "s", 0.05, 2,
          "an arm jog is judged by where the arm would be then");
  a.field("clearance_m", clearance_m, "m", 0, 0.3,
          "an arm jog may not come nearer to anything known");
  a.field("damping", damping, "", 0.001, 1, "damping of the Cartesian inverse near singularities");
}

Teleop::Teleop(Config config, const RobotGeometry& robot, const ArenaMap& arena,
               BaseController& base, ArmController& arm, PumpController& pumps)
    : config_(config),
      robot_(robot),
      base_(base),
      arm_(arm),
      pumps_(pumps),
      collision_(robot),
      arena_(arena) {}

void Teleop::setSpeedScale(double scale) { speed_scale_ = std::clamp(scale, 0.05, 1.0); }

void Teleop::jogBase(const JogBase& jog, Stamp received, double link_scale) {
  const double scale = speed_scale_ * link_scale;
  BaseSetpoint setpoint;
  setpoint.stamp = received;
  setpoint.writer = Writer::Hand;
  // A full stick asks for the full teleop speed; the operator's speed scale and a slow link shrink
  // it.
  setpoint.twist.vx_mps =
      unit(jog.twist.vx_mps / config_.max_speed_mps) * config_.max_speed_mps * scale;
  setpoint.twist.vy_mps =
      unit(jog.twist.vy_mps / config_.max_speed_mps) * config_.max_speed_mps * scale;
  setpoint.twist.wz_radps =
      unit(jog.twist.wz_radps / config_.max_yaw_rate_radps) * config_.max_yaw_rate_radps * scale;
  base_.setpoint(setpoint);
}

Vector6d Teleop::jointRates(const JogArm& jog, const Vector6d& q, double scale) const {
  if (jog.frame == JogFrame::Joint) {
    return (jog.velocity * scale)
        .cwiseMax(-config_.max_joint_rate_radps)
        .cwiseMin(config_.max_joint_rate_radps);
  }
  // To arm_base: the Base frame has the same axes up to the mount's rotation, the Tool frame turns
  // with the flange.
  const Eigen::Matrix3d R_armbase_frame =
      jog.frame == JogFrame::Tool
          ? Eigen::Matrix3d(robot_.arm.forward(q).linear())
          : Eigen::Matrix3d(robot_.X_base_armbase.pose().linear().transpose());
  Vector6d twist;
  twist.head<3>() =
      R_armbase_frame * limited(jog.velocity.head<3>(), config_.max_tool_speed_mps) * scale;
  twist.tail<3>() =
      R_armbase_frame * limited(jog.velocity.tail<3>(), config_.max_tool_rate_radps) * scale;
  const Eigen::Matrix<double, 6, 6> J = robot_.arm.jacobian(q);
  const Eigen::Matrix<double, 6, 6> damped =
      J * J.transpose() +
      config_.damping * config_.damping * Eigen::Matrix<double, 6, 6>::Identity();
  Vector6d qd = J.transpose() * damped.ldlt().solve(twist);
  const double worst = qd.cwiseAbs().maxCoeff();
  if (worst > config_.max_joint_rate_radps) qd *= config_.max_joint_rate_radps / worst;
  return qd;
}

std::string Teleop::objection(const Vector6d& q, const Vector6d& qd, const Pose2& X_map_base) {
  collision_.setScene(obstacles(arena_), X_map_base);
  const Clearance ahead = collision_.clearance(q + qd * config_.look_ahead_s);
  if (ahead.distance_m >= config_.clearance_m || ahead.distance_m > collision_.distance(q))
    return {};
  return fmt::format("{} is {:.0f} cm away", ahead.what, 100.0 * std::max(0.0, ahead.distance_m));
}

void Teleop::jogArm(const JogArm& jog, const Vector6d& q, const Pose2& X_map_base, Stamp received,
                    double link_scale) {
  ArmSetpoint setpoint;
  setpoint.kind = ArmSetpoint::Kind::JointVelocity;
  setpoint.stamp = received;
  setpoint.writer = Writer::Hand;
  setpoint.qd = jointRates(jog, q, speed_scale_ * link_scale);
  setpoint.stop_force_n = config_.guard_force_n;
  blocked_ = objection(q, setpoint.qd, X_map_base);
  if (!blocked_.empty()) setpoint.qd.setZero();
  arm_.setpoint(setpoint);
}

std::vector<ActuatorSpec> Teleop::actuators() {
  return {{kPumps, "Both pumps, duty"},
          {kPumpLeft, "Left pump, duty"},
          {kPumpRight, "Right pump, duty"}};
}

void Teleop::holdActuator(const HoldActuator& hold, Stamp received) {
  PumpSetpoint setpoint;
  setpoint.stamp = received;
  setpoint.writer = Writer::Hand;
  const double duty = std::clamp(hold.value, 0.0, 1.0);
  setpoint.duty = {hold.name == kPumpRight ? 0.0 : duty, hold.name == kPumpLeft ? 0.0 : duty};
  pumps_.setpoint(setpoint);
}

void Teleop::releaseAll(Stamp now) {
  BaseSetpoint base;
  base.stamp = now;
  base_.setpoint(base);
  ArmSetpoint arm;
  arm.kind = ArmSetpoint::Kind::Hold;
  arm.stamp = now;
  arm_.setpoint(arm);
  PumpSetpoint pumps;
  pumps.stamp = now;
  pumps_.setpoint(pumps);
}

}  // namespace kiln
