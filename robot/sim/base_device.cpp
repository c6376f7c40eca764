#include "robot/sim/base_device.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/units.h"

namespace kiln::sim {
namespace {

/// Eight lithium cells at rest: nominal 29.6 V, 33.2 V full.
double openCircuitVoltage(double charge) {
  struct Point {
    double charge, cell_v;
  };
  static constexpr Point kCurve[] = {{0.0, 3.0},  {0.05, 3.35}, {0.2, 3.57},
                                     {0.5, 3.70}, {0.8, 3.92},  {1.0, 4.15}};
  const Point* above = kCurve + 1;
  while (above->charge < charge && above->charge < 1.0) ++above;
  const Point &low = above[-1], &high = *above;
  const double share = (charge - low.charge) / (high.charge - low.charge);
  return 8.0 * (low.cell_v + share * (high.cell_v - low.cell_v));
}

}  // namespace

BaseDevice::BaseDevice(const BaseDeviceConfig& config, const RobotGeometry& robot,
                       const TrueRobot& truth, std::uint64_t seed)
    : config_(config),
      robot_(robot),
      truth_(truth),
      noise_(seed, "battery"),
      charge_(config.battery_charge) {}

std::string BaseDevice::write(Stamp now, const WheelCommands& command) {
  const double fastest = config_.max_speed_mps / robot_.wheel_radius_m;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!std::isfinite(command[i].steer_rad) || !std::isfinite(command[i].drive_radps)) {
      return fmt::format("command of wheel {} is not a number", i + 1);
    }
    if (std::fabs(command[i].steer_rad) > robot_.steer_limit_deg * kDeg + 1e-6) {
      return fmt::format("steering of wheel {} is {:.2f} rad, limit {:.2f}", i + 1,
                         command[i].steer_rad, robot_.steer_limit_deg * kDeg);
    }
    if (std::fabs(command[i].drive_radps) > fastest) {
      return fmt::format("wheel {} is to turn at {:.1f} rad/s, limit {:.1f}", i + 1,
                         command[i].drive_radps, fastest);
    }
  }
  command_ = command;
  command_time_ = now;
  commanded_ = true;
  return {};
}

void BaseDevice::reset() {
  commanded_ = false;
  watchdog_stop_ = true;
  command_ = {};
  steer_ref_ = drive_ref_ = integral_ = drive_torque_nm_ = {};
}

void BaseDevice::followCommand(Stamp now, double step_s) {
  watchdog_stop_ =
      batteryEmpty() || !commanded_ || toSeconds(now - command_time_) > config_.watchdog_s;
  if (watchdog_stop_) return driveTowards({}, step_s);
  const double turn = robot_.steer_rate_deg_s * kDeg * step_s;
  std::array<double, 4> wanted{};
  for (std::size_t i = 0; i < 4; ++i) {
    steer_ref_[i] += std::clamp(command_[i].steer_rad - steer_ref_[i], -turn, turn);
    wanted[i] = runaway_[0] * command_[i].drive_radps + runaway_[1] / robot_.wheel_radius_m;
  }
  driveTowards(wanted, step_s);
}

/// No wheel slows down by more than the drives can brake; one factor for all keeps the course.
void BaseDevice::driveTowards(const std::array<double, 4>& wanted, double step_s) {
  const double brake = config_.max_decel_mps2 / robot_.wheel_radius_m * step_s;
  double most = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double slower = std::copysign(1.0, drive_ref_[i]) * (drive_ref_[i] - wanted[i]);
    most = std::max(most, std::min(slower, std::fabs(drive_ref_[i])));
  }
  const double share = most > brake ? brake / most : 1.0;
  for (std::size_t i = 0; i < 4; ++i) drive_ref_[i] += share * (wanted[i] - drive_ref_[i]);
}

void BaseDevice::control(Stamp now, double step_s, Physics& physics) {
  const std::array<double, 4> steer_before = steer_ref_;
  followCommand(now, step_s);
  power_w_ = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const JointState steer = physics.steer(i), drive = physics.drive(i);
    const double steer_rate = (steer_ref_[i] - steer_before[i]) / step_s;
    // The encoder reads the wheel's angle less its offset, so the wheel ends up turned by the
    // offset.
    const double error = steer_ref_[i] + truth_.steer_offset_rad[i] - steer.position;
    const double steer_torque = std::clamp(
        config_.steer_gain * error + config_.steer_damping * (steer_rate - steer.velocity),
        -config_.steer_torque_nm, config_.steer_torque_nm);
    physics.setSteerTorque(i, steer_torque);
    // A wheel that is larger by e covers 1 + e of the nominal way: the physics wheel is nominal and
    // turns so much more.
    const double slip = drive_ref_[i] * (1.0 + truth_.wheel_radius_error[i]) - drive.velocity;
    const double limit = config_.drive_torque_nm;
    integral_[i] =
        std::clamp(integral_[i] + config_.drive_integral_gain * slip * step_s, -limit, limit);
    const double drive_torque = std::clamp(config_.drive_gain * slip + integral_[i], -limit, limit);
    physics.setDriveTorque(i, drive_torque);
    drive_torque_nm_[i] = drive_torque;
    power_w_ += std::fabs(drive_torque * drive.velocity) + std::fabs(steer_torque * steer.velocity);
  }
  const double open_v = openCircuitVoltage(charge_);
  current_a_ = batteryEmpty() ? 0.0 : config_.idle_a + power_w_ / open_v;
  charge_ = std::max(0.0, charge_ - current_a_ * step_s / (3600.0 * config_.battery_ah));
}

BaseState BaseDevice::report(Stamp now, const Physics& physics) {
  BaseState state;
  state.stamp = now;
  for (std::size_t i = 0; i < 4; ++i) {
    const double scale = 1.0 / (1.0 + truth_.wheel_radius_error[i]);
    const JointState drive = physics.drive(i);
    state.wheels[i].steer_rad = physics.steer(i).position - truth_.steer_offset_rad[i];
    state.wheels[i].drive_radps = drive.velocity * scale;
    state.wheels[i].drive_angle_rad = drive.position * scale;
    state.wheels[i].drive_current_a = drive_torque_nm_[i] / config_.torque_constant_nm_per_a;
  }
  state.battery_a = current_a_ + noise_.normal(config_.battery_noise_a);
  state.battery_v = openCircuitVoltage(charge_) - config_.battery_ohm * current_a_ +
                    noise_.normal(config_.battery_noise_v);
  return state;
}

}  // namespace kiln::sim
