#include "robot/sim_link/sim_devices.h"

#include <cmath>

namespace kiln {
namespace {

Error notFinite(const char* device) {
  return {ErrorCode::InvalidInput,
          std::string("a command to the ") + device + " is not a finite number; nothing was sent"};
}

}  // namespace

bool Outbox::take(v1::device::Advance& out) {
  const std::lock_guard lock(mutex_);
  if (!filled_) return false;
  out = std::exchange(pending_, v1::device::Advance{});
  filled_ = false;
  return true;
}

void Outbox::setOpen(bool open) {
  const std::lock_guard lock(mutex_);
  if (open_.exchange(open) == open) return;
  pending_.Clear();  // nothing that was said to a lost world moves a new one
  filled_ = false;
}

Result<void> SimArm::servo(const ArmServo& target) {
  if (!target.q.allFinite() || !target.qd.allFinite()) return tl::make_unexpected(notFinite("arm"));
  return outbox_.put([&](v1::device::Advance& m) {
    m.mutable_arm()->Clear();
    for (int i = 0; i < 6; ++i) {
      m.mutable_arm()->add_q_rad(target.q[i]);
      m.mutable_arm()->add_qd_radps(target.qd[i]);
    }
    m.mutable_arm()->set_sent_ns(toNanoseconds(clock_.now()));
  });
}

Result<void> SimArm::releaseProtectiveStop() {
  return outbox_.put([](v1::device::Advance& m) { m.set_release_protective_stop(true); });
}

Result<void> SimArm::setPayload(const ArmPayload& payload) {
  if (!std::isfinite(payload.mass_kg) || !payload.p_flange_com.allFinite())
    return tl::make_unexpected(notFinite("arm"));
  return outbox_.put([&](v1::device::Advance& m) {
    m.mutable_payload()->set_mass_kg(payload.mass_kg);
    m.mutable_payload()->clear_com_m();
    for (const double v : payload.p_flange_com) m.mutable_payload()->add_com_m(v);
  });
}

Result<void> SimArm::zeroForceSensor() {
  return outbox_.put([](v1::device::Advance& m) { m.set_zero_force(true); });
}

Result<void> SimDriveBase::write(const WheelCommands& command) {
  for (const WheelCommand& wheel : command) {
    if (!std::isfinite(wheel.steer_rad) || !std::isfinite(wheel.drive_radps))
      return tl::make_unexpected(notFinite("base"));
  }
  return outbox_.put([&](v1::device::Advance& m) {
    m.mutable_base()->Clear();
    for (const WheelCommand& wheel : command) {
      v1::device::Wheel* out = m.mutable_base()->add_wheels();
      out->set_steer_rad(wheel.steer_rad);
      out->set_drive_radps(wheel.drive_radps);
    }
  });
}

Result<void> SimPumps::write(const std::array<double, 2>& duty) {
  if (!std::isfinite(duty[0]) || !std::isfinite(duty[1]))
    return tl::make_unexpected(notFinite("pumps"));
  return outbox_.put([&](v1::device::Advance& m) {
    m.mutable_pumps()->set_left(duty[0]);
    m.mutable_pumps()->set_right(duty[1]);
  });
}

Result<void> SimGripper::write(const MagnetMask& on) {
  return outbox_.put([&](v1::device::Advance& m) {
    m.mutable_magnets()->set_on(static_cast<std::uint32_t>(on.to_ulong()));
  });
}

Result<void> SimStorage::write(std::span<const double> targets_m) {
  for (const double target : targets_m)
    if (!std::isfinite(target)) return tl::make_unexpected(notFinite("storage"));
  return outbox_.put([&](v1::device::Advance& m) {
    m.mutable_storage()->Clear();
    for (const double target : targets_m) m.mutable_storage()->add_position_m(target);
  });
}

Result<void> SimArena::requestReset() {
  return outbox_.put([](v1::device::Advance& m) { m.set_request_reset(true); });
}

Result<void> SimArena::startClock() {
  if (clock_told_) return {};
  auto put = outbox_.put([](v1::device::Advance& m) { m.set_start_clock(true); });
  if (put) clock_told_ = true;
  return put;
}

void SensorSwitch::fill(v1::device::Advance& m) const {
  m.mutable_sensors()->set_lidar(on_[kLidar]);
  m.mutable_sensors()->set_thermal(on_[kThermal]);
  m.mutable_sensors()->set_operator_camera(on_[kOperatorCamera]);
  m.mutable_sensors()->set_head_camera(on_[kHeadCamera]);
}

Result<void> SensorSwitch::set(int sensor, bool on) {
  const std::lock_guard lock(mutex_);
  on_[static_cast<std::size_t>(sensor)] = on;
  return outbox_.put([this](v1::device::Advance& m) { fill(m); });
}

void SensorSwitch::repeat() {
  const std::lock_guard lock(mutex_);
  (void)outbox_.put([this](v1::device::Advance& m) { fill(m); });
}

}  // namespace kiln
