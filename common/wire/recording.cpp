#include "common/wire/recording.h"

#include <cmath>

#include "common/wire/arm_state.h"
#include "common/wire/geometry.h"
#include "common/wire/proto_message.h"
#include "kiln/v1/recording.pb.h"

namespace kiln::wire {
namespace {

constexpr std::size_t kMaxSampleBytes = 64u << 10;

void toProto(const BaseState& base, v1::BaseState& out) {
  out.set_stamp_ns(toNanoseconds(base.stamp));
  out.set_seq(base.seq);
  for (const WheelState& wheel : base.wheels) {
    v1::WheelState& row = *out.add_wheels();
    row.set_steer_rad(wheel.steer_rad);
    row.set_drive_radps(wheel.drive_radps);
    row.set_drive_angle_rad(wheel.drive_angle_rad);
  }
  out.set_battery_v(base.battery_v);
  out.set_battery_a(base.battery_a);
}

void toProto(const PumpsState& pumps, v1::PumpsState& out) {
  out.set_stamp_ns(toNanoseconds(pumps.stamp));
  out.set_seq(pumps.seq);
  for (const double duty : pumps.duty) out.add_duty(duty);
  for (const double current : pumps.current_a) out.add_current_a(current);
  out.set_contact_switch(pumps.contact_switch);
  out.set_heartbeat_lost(pumps.heartbeat_lost);
}

Result<BaseState> fromProto(const v1::BaseState& in) {
  BaseState base;
  if (in.wheels_size() != static_cast<int>(base.wheels.size())) {
    return makeError(ErrorCode::InvalidInput, "device sample: {} wheels, {} are due; dropped",
                     in.wheels_size(), base.wheels.size());
  }
  base.stamp = stampFromNanoseconds(in.stamp_ns());
  base.seq = in.seq();
  for (int i = 0; i < in.wheels_size(); ++i) {
    const v1::WheelState& row = in.wheels(i);
    base.wheels[static_cast<std::size_t>(i)] = {row.steer_rad(), row.drive_radps(),
                                                row.drive_angle_rad()};
    if (!std::isfinite(row.steer_rad() + row.drive_radps() + row.drive_angle_rad()))
      return makeError(ErrorCode::InvalidInput, "device sample: a wheel is not finite; dropped");
  }
  base.battery_v = in.battery_v();
  base.battery_a = in.battery_a();
  return base;
}

Result<PumpsState> fromProto(const v1::PumpsState& in) {
  PumpsState pumps;
  if (auto ok = copyFixed(in.duty(), pumps.duty, "pump duty"); !ok)
    return tl::make_unexpected(ok.error());
  if (auto ok = copyFixed(in.current_a(), pumps.current_a, "pump current"); !ok)
    return tl::make_unexpected(ok.error());
  pumps.stamp = stampFromNanoseconds(in.stamp_ns());
  pumps.seq = in.seq();
  pumps.contact_switch = in.contact_switch();
  pumps.heartbeat_lost = in.heartbeat_lost();
  return pumps;
}

void toProto(const GripperState& gripper, v1::GripperState& out) {
  out.set_stamp_ns(toNanoseconds(gripper.stamp));
  out.set_seq(gripper.seq);
  out.set_on(static_cast<std::uint32_t>(gripper.on.to_ulong()));
  for (const double current : gripper.current_a) out.add_current_a(current);
  out.set_contact(gripper.contact);
}

void toProto(const StorageState& storage, v1::StorageState& out) {
  out.set_stamp_ns(toNanoseconds(storage.stamp));
  out.set_seq(storage.seq);
  for (const CompartmentState& from : storage.compartments) {
    v1::CompartmentState& row = *out.add_compartments();
    row.set_position_m(from.position_m);
    row.set_target_m(from.target_m);
    row.set_current_a(from.current_a);
    row.set_moving(from.moving);
    row.set_blocked(from.blocked);
  }
  out.set_setpoint_lost(storage.setpoint_lost);
}

Result<GripperState> fromProto(const v1::GripperState& in) {
  GripperState gripper;
  if (auto ok = copyFixed(in.current_a(), gripper.current_a, "gripper current"); !ok)
    return tl::make_unexpected(ok.error());
  gripper.stamp = stampFromNanoseconds(in.stamp_ns());
  gripper.seq = in.seq();
  gripper.on = GripperPoles(in.on());
  gripper.contact = in.contact();
  return gripper;
}

Result<StorageState> fromProto(const v1::StorageState& in) {
  StorageState storage;
  storage.stamp = stampFromNanoseconds(in.stamp_ns());
  storage.seq = in.seq();
  storage.setpoint_lost = in.setpoint_lost();
  for (const v1::CompartmentState& row : in.compartments()) {
    if (!std::isfinite(row.position_m() + row.target_m() + row.current_a()))
      return makeError(ErrorCode::InvalidInput,
                       "device sample: a compartment is not finite; dropped");
    storage.compartments.push_back(
        {row.position_m(), row.target_m(), row.current_a(), row.moving(), row.blocked()});
  }
  return storage;
}

bool finite(const Pose2& pose) { return std::isfinite(pose.x_m + pose.y_m + pose.yaw_rad); }

}  // namespace

std::string encode(const DeviceSample& sample) {
  v1::DeviceSample out;
  out.set_stamp_ns(toNanoseconds(sample.stamp));
  if (sample.arm) toProto(*sample.arm, *out.mutable_arm());
  if (sample.base) toProto(*sample.base, *out.mutable_base());
  if (sample.pumps) toProto(*sample.pumps, *out.mutable_pumps());
  if (sample.gripper) toProto(*sample.gripper, *out.mutable_gripper());
  if (sample.storage) toProto(*sample.storage, *out.mutable_storage());
  toProto(sample.X_odom_base, *out.mutable_x_odom_base());
  toProto(sample.X_map_odom, *out.mutable_x_map_odom());
  out.set_resets(sample.resets);
  return serialise(out);
}

Result<DeviceSample> decodeDeviceSample(std::string_view bytes) {
  const auto in = parse<v1::DeviceSample>(bytes, kMaxSampleBytes, "device sample");
  if (!in) return tl::make_unexpected(in.error());
  DeviceSample sample;
  sample.stamp = stampFromNanoseconds(in->stamp_ns());
  if (in->has_arm()) {
    auto arm = fromProto(in->arm());
    if (!arm) return tl::make_unexpected(arm.error());
    if (!arm->q.allFinite() || !arm->qd.allFinite())
      return makeError(ErrorCode::InvalidInput, "device sample: a joint is not finite; dropped");
    sample.arm = *arm;
  }
  if (in->has_base()) {
    auto base = fromProto(in->base());
    if (!base) return tl::make_unexpected(base.error());
    sample.base = *base;
  }
  if (in->has_pumps()) {
    auto pumps = fromProto(in->pumps());
    if (!pumps) return tl::make_unexpected(pumps.error());
    sample.pumps = *pumps;
  }
  if (in->has_gripper()) {
    auto gripper = fromProto(in->gripper());
    if (!gripper) return tl::make_unexpected(gripper.error());
    sample.gripper = *gripper;
  }
  if (in->has_storage()) {
    auto storage = fromProto(in->storage());
    if (!storage) return tl::make_unexpected(storage.error());
    sample.storage = *storage;
  }
  sample.X_odom_base = fromProto(in->x_odom_base());
  sample.X_map_odom = fromProto(in->x_map_odom());
  sample.resets = in->resets();
  if (!finite(sample.X_odom_base) || !finite(sample.X_map_odom))
    return makeError(ErrorCode::InvalidInput, "device sample: a pose is not finite; dropped");
  return sample;
}

}  // namespace kiln::wire
