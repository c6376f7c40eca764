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

bool finite(const Pose2& pose) { return std::isfinite(pose.x_m + pose.y_m + pose.yaw_rad); }

}  // namespace

std::string encode(const DeviceSample& sample) {
  v1::DeviceSample out;
  out.set_stamp_ns(toNanoseconds(sample.stamp));
  if (sample.arm) toProto(*sample.arm, *out.mutable_arm());
  if (sample.base) toProto(*sample.base, *out.mutable_base());
  if (sample.pumps) toProto(*sample.pumps, *out.mutable_pumps());
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
  sample.X_odom_base = fromProto(in->x_odom_base());
  sample.X_map_odom = fromProto(in->x_map_odom());
  sample.resets = in->resets();
  if (!finite(sample.X_odom_base) || !finite(sample.X_map_odom))
    return makeError(ErrorCode::InvalidInput, "device sample: a pose is not finite; dropped");
  return sample;
}

}  // namespace kiln::wire
