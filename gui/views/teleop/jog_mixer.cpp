#include "gui/views/teleop/jog_mixer.h"

#include <algorithm>

namespace kiln::gui {
namespace {

double unit(double v) { return std::clamp(v, -1.0, 1.0); }

/// A direction at most 1 long: two keys at once are not faster than one.
Eigen::Vector3d unitVector(const Eigen::Vector3d& v) {
  return v.norm() > 1.0 ? Eigen::Vector3d(v.normalized()) : v;
}

}  // namespace

void JogMixer::rest() {
  drive = {};
  arm = {};
  turn = arm_up = 0.0;
}

JogBase JogMixer::base(const JogKeys& keys) const {
  const Eigen::Vector3d k = keys.base();
  const Eigen::Vector3d plane = unitVector({drive.y() + k.x(), -drive.x() + k.y(), 0.0});
  return {{config_.speed_mps * plane.x(), config_.speed_mps * plane.y(),
           config_.yaw_rate_radps * unit(k.z() - turn)}};
}

JogArm JogMixer::armSetpoint(const JogKeys& keys) const {
  JogArm jog;
  const Eigen::Vector3d stick(arm.y(), -arm.x(), arm_up);  // forward, left, up
  if (arm_mode == ArmJogMode::Joint && stick.norm() > 0.0) {
    jog.frame = JogFrame::Joint;
    jog.velocity[std::clamp(joint, 0, 5)] = config_.joint_rate_radps * unit(-stick.y());
    return jog;
  }
  Eigen::Vector3d move = keys.armMove(), turn_rate = keys.armTurn();
  if (arm_mode == ArmJogMode::Move) move += stick;
  // Stick to the right turns the tool to the right, stick up lifts its nose, the bar rolls it.
  if (arm_mode == ArmJogMode::Turn) turn_rate += Eigen::Vector3d(arm_up, -arm.y(), -arm.x());
  jog.velocity.head<3>() = config_.tool_speed_mps * unitVector(move);
  jog.velocity.tail<3>() = config_.tool_rate_radps * unitVector(turn_rate);
  return jog;
}

bool JogMixer::moves(const JogBase& jog) {
  return jog.twist.vx_mps != 0.0 || jog.twist.vy_mps != 0.0 || jog.twist.wz_radps != 0.0;
}

bool JogMixer::moves(const JogArm& jog) { return !jog.velocity.isZero(0.0); }

}  // namespace kiln::gui
