#include "tests/support/fake_devices.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kServoLag = 0.02;     // s
constexpr double kDriveLag = 0.05;     // s
constexpr double kServoTimeout = 0.2;  // s
constexpr double kBaseTimeout = 0.25;  // s
constexpr double kHeartbeatTimeout = 0.2;
constexpr double kRunningCurrent = 3.0;  // A at full duty
constexpr double kBrake = 2.0;           // m/s^2

}  // namespace

FakeArm::FakeArm(const Clock& clock, const RobotGeometry& robot, const Vector6d& q_start)
    : clock_(clock), limits_(robot.arm), last_(clock.now()) {
  state_.q = q_start;
  state_.stamp = last_;
}

std::optional<ArmState> FakeArm::state() const {
  const std::lock_guard lock(mutex_);
  ArmState shown = frozen_ ? *frozen_ : state_;
  shown.wrench_tool.head<3>() -= zero_n_;
  return shown;
}
Vector6d FakeArm::trueQ() const {
  const std::lock_guard lock(mutex_);
  return state_.q;
}

Result<void> FakeArm::servo(const ArmServo& target) {
  const std::lock_guard lock(mutex_);
  sent_.push_back(target);
  if (state_.safety == ArmSafetyMode::ProtectiveStop) {
    return makeError(ErrorCode::Refused, "arm is in a protective stop");
  }
  const Stamp now = clock_.now();
  if (target_ && now > target_stamp_) {
    const Vector6d speed = (target.q - target_->q) / toSeconds(now - target_stamp_);
    if ((speed.cwiseAbs().array() > 1.05 * limits_.velocity_limit.array()).any()) {
      state_.safety = ArmSafetyMode::ProtectiveStop;
      return makeError(ErrorCode::Refused, "target needs more than the joint speed limit");
    }
  }
  target_ = target;
  target_stamp_ = now;
  return {};
}

Result<void> FakeArm::releaseProtectiveStop() {
  const std::lock_guard lock(mutex_);
  ++releases_;
  state_.safety = ArmSafetyMode::Normal;
  target_.reset();
  return {};
}

Result<void> FakeArm::setPayload(const ArmPayload& payload) {
  const std::lock_guard lock(mutex_);
  payloads_.push_back(payload);
  return {};
}

Result<void> FakeArm::zeroForceSensor() {
  const std::lock_guard lock(mutex_);
  ++zeroings_;
  zero_n_ = state_.wrench_tool.head<3>();
  return {};
}

void FakeArm::advance() {
  const std::lock_guard lock(mutex_);
  const Stamp now = clock_.now();
  const double dt = toSeconds(now - last_);
  last_ = now;
  state_.stamp = now;
  ++state_.seq;
  const bool held = jammed_ || !target_ || !state_.powered ||
                    state_.safety == ArmSafetyMode::ProtectiveStop ||
                    toSeconds(now - target_stamp_) > kServoTimeout;
  if (held || dt <= 0.0) {
    state_.qd.setZero();
    return;
  }
  const Vector6d before = state_.q;
  state_.q += (target_->q + target_->qd * kServoLag - state_.q) * (1.0 - std::exp(-dt / kServoLag));
  state_.qd = (state_.q - before) / dt;
}

void FakeArm::setForce(const Eigen::Vector3d& force_n) {
  const std::lock_guard lock(mutex_);
  state_.wrench_tool.head<3>() = force_n;
}
void FakeArm::setSafety(ArmSafetyMode safety) {
  const std::lock_guard lock(mutex_);
  state_.safety = safety;
}
void FakeArm::setPowered(bool powered) {
  const std::lock_guard lock(mutex_);
  state_.powered = powered;
  target_.reset();
}
void FakeArm::freezeState(bool frozen) {
  const std::lock_guard lock(mutex_);
  if (!frozen)
    frozen_.reset();
  else if (!frozen_)
    frozen_ = state_;
}
void FakeArm::setQ(const Vector6d& q) {
  const std::lock_guard lock(mutex_);
  state_.q = q;
  target_.reset();
}
void FakeArm::jam(bool jammed) {
  const std::lock_guard lock(mutex_);
  jammed_ = jammed;
}
std::vector<ArmServo> FakeArm::sent() const {
  const std::lock_guard lock(mutex_);
  return sent_;
}
int FakeArm::releases() const {
  const std::lock_guard lock(mutex_);
  return releases_;
}
std::vector<ArmPayload> FakeArm::payloads() const {
  const std::lock_guard lock(mutex_);
  return payloads_;
}
int FakeArm::zeroings() const {
  const std::lock_guard lock(mutex_);
  return zeroings_;
}

FakeBase::FakeBase(const Clock& clock, const RobotGeometry& robot)
    : clock_(clock), robot_(robot), last_(clock.now()) {
  state_.stamp = last_;
  state_.battery_v = 29.6;
}

std::optional<BaseState> FakeBase::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

Result<void> FakeBase::write(const WheelCommands& command) {
  const std::lock_guard lock(mutex_);
  sent_.push_back(command);
  command_ = command;
  command_stamp_ = clock_.now();
  commanded_ = true;
  return {};
}

void FakeBase::advance() {
  const std::lock_guard lock(mutex_);
  const Stamp now = clock_.now();
  const double dt = toSeconds(now - last_);
  last_ = now;
  if (dt <= 0.0) return;
  const bool lost = !commanded_ || toSeconds(now - command_stamp_) > kBaseTimeout;
  const double steer_step = robot_.steer_rate_deg_s * kDeg * dt;
  const double brake_step = kBrake / robot_.wheel_radius_m * dt;
  // Mean of the wheel velocities: the base of a test does not slip sideways, it follows the
  // least-squares motion.
  Eigen::Vector2d v = Eigen::Vector2d::Zero();
  double wz = 0.0, lever2 = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    WheelState& wheel = state_.wheels[i];
    if (!lost && !jammed_) {
      wheel.steer_rad +=
          std::clamp(command_[i].steer_rad - wheel.steer_rad, -steer_step, steer_step);
      wheel.drive_radps +=
          (command_[i].drive_radps + sag_mps_ / robot_.wheel_radius_m - wheel.drive_radps) *
          (1.0 - std::exp(-dt / kDriveLag));
    } else {
      wheel.drive_radps -= std::clamp(wheel.drive_radps, -brake_step, brake_step);
    }
    if (jammed_) wheel.drive_radps = 0.0;
    wheel.drive_angle_rad += wheel.drive_radps * dt;
    const double x = i < 2 ? robot_.wheel_x_m : -robot_.wheel_x_m;
    const double y = i % 2 == 0 ? robot_.wheel_y_m : -robot_.wheel_y_m;
    const Eigen::Vector2d rolling =
        wheel.drive_radps * robot_.wheel_radius_m *
        Eigen::Vector2d(std::cos(wheel.steer_rad), std::sin(wheel.steer_rad));
    v += 0.25 * rolling;
    wz += x * rolling.y() - y * rolling.x();
    lever2 += x * x + y * y;
  }
  wz /= lever2;
  const double yaw = X_map_base_.yaw_rad + 0.5 * wz * dt;
  X_map_base_.x_m += (std::cos(yaw) * v.x() - std::sin(yaw) * v.y()) * dt;
  X_map_base_.y_m += (std::sin(yaw) * v.x() + std::cos(yaw) * v.y()) * dt;
  X_map_base_.yaw_rad = wrapAngle(X_map_base_.yaw_rad + wz * dt);
  if (frozen_) return;
  state_.stamp = now;
  ++state_.seq;
}

void FakeBase::freezeState(bool frozen) {
  const std::lock_guard lock(mutex_);
  frozen_ = frozen;
}
void FakeBase::jam(bool jammed) {
  const std::lock_guard lock(mutex_);
  jammed_ = jammed;
}
void FakeBase::setSag(double speed_mps) {
  const std::lock_guard lock(mutex_);
  sag_mps_ = speed_mps;
}
void FakeBase::setSteer(const std::array<double, 4>& steer_rad) {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < 4; ++i) state_.wheels[i].steer_rad = steer_rad[i];
}
void FakeBase::setTruePose(const Pose2& X_map_base) {
  const std::lock_guard lock(mutex_);
  X_map_base_ = X_map_base;
}
Pose2 FakeBase::truePose() const {
  const std::lock_guard lock(mutex_);
  return X_map_base_;
}
std::vector<WheelCommands> FakeBase::sent() const {
  const std::lock_guard lock(mutex_);
  return sent_;
}

FakePumps::FakePumps(const Clock& clock)
    : clock_(clock), write_stamp_(clock.now()), last_(clock.now()) {
  state_.stamp = last_;
}

std::optional<PumpsState> FakePumps::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

Result<void> FakePumps::write(const std::array<double, 2>& duty) {
  const std::lock_guard lock(mutex_);
  duty_ = duty;
  write_stamp_ = clock_.now();
  ++writes_;
  return {};
}

void FakePumps::advance() {
  const std::lock_guard lock(mutex_);
  const Stamp now = clock_.now();
  const double dt = toSeconds(now - last_);
  last_ = now;
  const bool lost = toSeconds(now - write_stamp_) > kHeartbeatTimeout;
  std::array<double, 2> current{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double wanted = lost ? 0.0 : duty_[i];
    const double before = speed_[i];
    speed_[i] += std::clamp(wanted - speed_[i], -dt / 0.4, dt / 0.4);
    current[i] = dry_[i] ? 0.0 : kRunningCurrent * wanted;
    if (!dry_[i]) litres_ += 1.6 / 60.0 * 0.5 * (before + speed_[i]) * dt;
  }
  if (frozen_) return;
  state_.duty = lost ? std::array<double, 2>{} : duty_;
  state_.current_a = current;
  state_.heartbeat_lost = lost;
  state_.stamp = now;
  ++state_.seq;
}

void FakePumps::setDry(int pump, bool dry) {
  const std::lock_guard lock(mutex_);
  dry_[static_cast<std::size_t>(pump)] = dry;
}
void FakePumps::freezeState(bool frozen) {
  const std::lock_guard lock(mutex_);
  frozen_ = frozen;
}
int FakePumps::writes() const {
  const std::lock_guard lock(mutex_);
  return writes_;
}
double FakePumps::trueLitres() const {
  const std::lock_guard lock(mutex_);
  return litres_;
}

}  // namespace kiln
