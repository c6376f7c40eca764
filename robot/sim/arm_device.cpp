#include "robot/sim/arm_device.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace kiln::sim {
namespace {
constexpr double kGravity_mps2 = 9.81;
constexpr double kDriftTime_s = 600.0;
constexpr double kNoticed_kg = 0.3;  ///< less than a brick: the head's own error
}  // namespace

ArmDevice::ArmDevice(const ArmDeviceConfig& config, const RobotGeometry& robot,
                     const TrueRobot& truth, std::uint64_t seed)
    : config_(config),
      robot_(robot),
      noise_(seed, "arm force"),
      head_kg_(truth.head_kg),
      p_flange_head_(truth.p_flange_head) {
  Random random(seed, "force sensor");
  for (double& v : sensor_offset_n_)
    v = random.uniform(-config.force_offset_n, config.force_offset_n);
  for (double& v : drift_direction_) v = random.normal(1.0);
  drift_direction_.normalize();
}

std::string ArmDevice::setPayload(const ArmPayload& payload) {
  if (!std::isfinite(payload.mass_kg) || !payload.p_flange_com.allFinite())
    return "payload is not a number";
  if (payload.mass_kg < 0.0 || payload.mass_kg > config_.max_payload_kg)
    return fmt::format("payload of {:.1f} kg, limit {:.1f}", payload.mass_kg,
                       config_.max_payload_kg);
  payload_ = payload;
  p_told_.reset();
  v_told_.reset();
  return {};
}

/// @param since_s  the target that is being followed was given so long ago.
std::string ArmDevice::refusal(double since_s, const Vector6d& q, const Vector6d& qd) const {
  // One servo period of the slowest UR when none is being followed.
  const double dt = following_ ? std::max(0.004, since_s) : 0.008;
  const Vector6d& from = following_ ? target_q_ : q_ref_;
  for (int i = 0; i < 6; ++i) {
    if (!std::isfinite(q[i]) || !std::isfinite(qd[i]))
      return fmt::format("servo target of joint {} is not a number", i + 1);
    if (std::fabs(q[i]) > robot_.arm.position_limit[i]) {
      return fmt::format("servo target of joint {} is {:.3f} rad, limit {:.3f}", i + 1, q[i],
                         robot_.arm.position_limit[i]);
    }
    const double limit = config_.speed_tolerance * robot_.arm.velocity_limit[i];
    const double jump = std::max(0.0, std::fabs(q[i] - from[i]) - config_.position_slack_rad);
    if (std::fabs(qd[i]) > limit || jump > limit * dt) {
      return fmt::format("servo target of joint {} needs {:.2f} rad/s, limit {:.2f}", i + 1,
                         std::max(std::fabs(qd[i]), jump / dt), robot_.arm.velocity_limit[i]);
    }
  }
  return {};
}

std::string ArmDevice::servo(Stamp now, const Vector6d& q, const Vector6d& qd,
                             std::optional<Stamp> sent) {
  if (!powered_) return "servo target ignored: no power";
  if (stopped_) return "servo target ignored: protective stop";
  Duration since = now - target_time_;
  if (sent && target_sent_) since = std::max(since, *sent - *target_sent_);
  if (std::string why = refusal(toSeconds(since), q, qd); !why.empty()) {
    if (carried_ && toSeconds(now - *carried_) <= config_.carry_grace_s) return {};
    protectiveStop();
    return why;
  }
  target_q_ = q;
  target_qd_ = qd;
  target_time_ = now;
  target_sent_ = sent;
  following_ = true;
  return {};
}

void ArmDevice::releaseProtectiveStop() { stopped_ = false; }

void ArmDevice::setPowered(bool powered) {
  powered_ = powered;
  if (!powered) following_ = false;
}

void ArmDevice::protectiveStop() {
  stopped_ = true;
  following_ = false;
}

void ArmDevice::reset(Stamp now, const Vector6d& q) {
  if (now > Stamp{}) carried_ = now;  // the first time nothing can be under way
  q_ref_ = q;
  qd_ref_.setZero();
  wrench_.setZero();
  v_head_.reset();
  p_told_.reset();
  v_told_.reset();
  following_ = stopped_ = false;
}

void ArmDevice::advanceReference(Stamp now, double step_s) {
  if (following_ && toSeconds(now - target_time_) > config_.watchdog_s) following_ = false;
  if (following_) {
    // The target is for the moment it came; feed-forward carries it to this one, for one slow servo
    // period at most.
    const double age = std::min(0.016, toSeconds(now - target_time_));
    q_ref_ = target_q_ + age * target_qd_;
    qd_ref_ = target_qd_;
    return;
  }
  for (int i = 0; i < 6; ++i) {
    const double brake = config_.hold_decel_radps2 * step_s;
    qd_ref_[i] -= std::clamp(qd_ref_[i], -brake, brake);
    q_ref_[i] += qd_ref_[i] * step_s;
  }
}

void ArmDevice::control(Stamp now, double step_s, Physics& physics) {
  advanceReference(now, step_s);
  const double w = config_.bandwidth_radps;
  const Vector6d q = physics.armPosition(), qd = physics.armVelocity();
  if (stopped_) {
    // Brakes hold where the arm came to rest; they do not press on against an obstacle.
    for (int i = 0; i < 6; ++i) q_ref_[i] = q[i] + std::clamp(q_ref_[i] - q[i], -0.02, 0.02);
  }
  carryPayload(physics);
  physics.accelerateArm(w * w * (q_ref_ - q) + 2.0 * w * (qd_ref_ - qd));
}

Vector6d ArmDevice::contactWrench(const Physics& physics) const {
  Vector6d sum = Vector6d::Zero();
  const Eigen::Isometry3d X_map_armbase = physics.X_map_base() * robot_.X_base_armbase.pose();
  const Eigen::Isometry3d X_armbase_tool =
      robot_.arm.forward(physics.armPosition()) * robot_.X_flange_tool.pose();
  for (const BodyContact& contact : physics.contacts()) {
    if (!contact.arm) continue;
    const Eigen::Vector3d force = X_map_armbase.linear().transpose() * contact.force_on_a;
    const Eigen::Vector3d lever =
        X_map_armbase.inverse() * contact.point - X_armbase_tool.translation();
    sum.head<3>() += force;
    sum.tail<3>() += lever.cross(force);
  }
  if (physics.bricks() == nullptr) return sum;
  const GripState& grip = physics.bricks()->grip();
  const Eigen::Matrix3d R = X_map_armbase.linear().transpose();
  const Eigen::Vector3d force = R * grip.force_n;
  const Eigen::Vector3d lever = X_map_armbase.inverse() * grip.p_map - X_armbase_tool.translation();
  sum.head<3>() += force;
  sum.tail<3>() += R * grip.torque_nm + lever.cross(force);
  return sum;
}

/// What was told beyond the head itself: the controller carries it, as it carries the arm.
void ArmDevice::carryPayload(Physics& physics) const {
  if (physics.bricks() == nullptr) return;
  const double kg = payload_.mass_kg - config_.head_kg;
  if (kg < kNoticed_kg) return physics.setCarried(0.0, Eigen::Vector3d::Zero());
  const Eigen::Vector3d head(0, 0, 0.09);  // nominal, as TrueRobot's
  physics.setCarried(kg, (payload_.mass_kg * payload_.p_flange_com - config_.head_kg * head) / kg);
}

/// A mass at the flange pulls with m (g - a); the head's own turning inertia is left out.
Vector6d ArmDevice::uncompensatedLoad(double step_s, const Physics& physics) {
  const Eigen::Isometry3d X_map_armbase = physics.X_map_base() * robot_.X_base_armbase.pose();
  const Eigen::Isometry3d X_armbase_flange = robot_.arm.forward(physics.armPosition());
  const Eigen::Vector3d tool = X_armbase_flange * robot_.X_flange_tool.pose().translation();
  const Eigen::Vector3d head = X_armbase_flange * p_flange_head_,
                        told = X_armbase_flange * payload_.p_flange_com;
  const Eigen::Vector3d v_head = physics.flangePointVelocity(X_map_armbase * head);
  Eigen::Vector3d a_head = Eigen::Vector3d::Zero(), a_told = Eigen::Vector3d::Zero();
  if (v_head_) a_head = (v_head - *v_head_) / step_s;
  v_head_ = v_head;
  if (p_told_) {
    const Eigen::Vector3d v_told = (told - *p_told_) / step_s;
    if (v_told_) a_told = (v_told - *v_told_) / step_s;
    v_told_ = v_told;
  }
  p_told_ = told;
  const Eigen::Vector3d gravity(0, 0, -kGravity_mps2);
  const Eigen::Vector3d true_n =
      head_kg_ * (X_map_armbase.linear().transpose() * (gravity - a_head));
  const Eigen::Vector3d told_n = payload_.mass_kg * (gravity - a_told);
  Vector6d load;
  load << true_n - told_n, (head - tool).cross(true_n) - (told - tool).cross(told_n);
  return load;
}

Eigen::Vector3d ArmDevice::sensorError(Stamp now) const {
  return sensor_offset_n_ +
         config_.force_drift_n * toSeconds(now - Stamp{}) / kDriftTime_s * drift_direction_;
}

void ArmDevice::sense(Stamp now, double step_s, const Physics& physics) {
  const Vector6d wrench = contactWrench(physics) + uncompensatedLoad(step_s, physics);
  const double alpha = step_s / (config_.force_filter_s + step_s);
  wrench_ += alpha * (wrench - wrench_);
  if (wrench_.head<3>().norm() > (reduced_ ? config_.reduced_force_n : config_.protective_force_n))
    protectiveStop();
  R_armbase_flange_ = robot_.arm.forward(physics.armPosition()).linear();
  sensor_error_n_ = sensorError(now);
}

void ArmDevice::zeroForceSensor() {
  zero_flange_.head<3>() = R_armbase_flange_.transpose() * wrench_.head<3>() + sensor_error_n_;
  zero_flange_.tail<3>() = R_armbase_flange_.transpose() * wrench_.tail<3>();
}

ArmState ArmDevice::report(Stamp now, const Physics& physics) {
  ArmState state;
  state.stamp = now;
  state.q = physics.armPosition();
  state.qd = physics.armVelocity();
  state.wrench_tool = wrench_;
  state.wrench_tool.head<3>() += R_armbase_flange_ * (sensor_error_n_ - zero_flange_.head<3>());
  state.wrench_tool.tail<3>() -= R_armbase_flange_ * zero_flange_.tail<3>();
  for (int i = 0; i < 6; ++i)
    state.wrench_tool[i] += noise_.normal(i < 3 ? config_.force_noise_n : config_.torque_noise_nm);
  state.safety = stopped_   ? ArmSafetyMode::ProtectiveStop
                 : reduced_ ? ArmSafetyMode::Reduced
                            : ArmSafetyMode::Normal;
  state.powered = powered_;
  return state;
}

}  // namespace kiln::sim
