#include "robot/sim_link/device_codec.h"

#include <cmath>
#include <cstring>

#include "common/geom/frames.h"

namespace kiln {
namespace {

constexpr std::size_t kThermalPixels = 160 * 120;

Stamp shifted(std::int64_t world_ns, Duration shift) {
  return stampFromNanoseconds(world_ns) + shift;
}

template <class T>
std::vector<T> values(const char* from, std::size_t count) {
  std::vector<T> out(count);
  std::memcpy(out.data(), from, count * sizeof(T));
  return out;
}

}  // namespace

Result<ArmState> armFromProto(const v1::device::Report& report, Duration shift) {
  const v1::device::ArmReport& m = report.arm();
  if (m.q_rad_size() != 6 || m.qd_radps_size() != 6 || m.wrench_size() != 6) {
    return makeError(ErrorCode::Truncated, "arm report of the world has {} joints instead of 6",
                     m.q_rad_size());
  }
  if (m.safety() > static_cast<std::uint32_t>(ArmSafetyMode::Fault)) {
    return makeError(ErrorCode::InvalidInput, "arm report of the world has safety mode {}",
                     m.safety());
  }
  ArmState state;
  state.stamp = shifted(report.now_ns(), shift);
  state.seq = report.seq();
  for (int i = 0; i < 6; ++i) {
    state.q[i] = m.q_rad(i);
    state.qd[i] = m.qd_radps(i);
    state.wrench_tool[i] = m.wrench(i);
  }
  state.safety = static_cast<ArmSafetyMode>(m.safety());
  state.powered = m.powered();
  return state;
}

Result<BaseState> baseFromProto(const v1::device::Report& report, Duration shift) {
  const v1::device::BaseReport& m = report.base();
  if (m.wheels_size() != 4) {
    return makeError(ErrorCode::Truncated, "base report of the world has {} wheels instead of 4",
                     m.wheels_size());
  }
  BaseState state;
  state.stamp = shifted(report.now_ns(), shift);
  state.seq = report.seq();
  for (int i = 0; i < 4; ++i) {
    const v1::device::Wheel& wheel = m.wheels(i);
    state.wheels[static_cast<std::size_t>(i)] = {wheel.steer_rad(), wheel.drive_radps(),
                                                 wheel.drive_angle_rad(), wheel.drive_current_a()};
  }
  state.battery_v = m.battery_v();
  state.battery_a = m.battery_a();
  return state;
}

Result<PumpsState> pumpsFromProto(const v1::device::Report& report, Duration shift) {
  const v1::device::PumpReport& m = report.pumps();
  if (m.duty_size() != 2 || m.current_a_size() != 2) {
    return makeError(ErrorCode::Truncated, "pump report of the world has {} pumps instead of 2",
                     m.duty_size());
  }
  PumpsState state;
  state.stamp = shifted(report.now_ns(), shift);
  state.seq = report.seq();
  for (int i = 0; i < 2; ++i) {
    state.duty[static_cast<std::size_t>(i)] = m.duty(i);
    state.current_a[static_cast<std::size_t>(i)] = m.current_a(i);
  }
  state.contact_switch = m.contact_switch();
  state.heartbeat_lost = m.heartbeat_lost();
  return state;
}

Result<PointCloudPtr> cloudFromProto(const v1::device::LidarScan& scan, Duration shift) {
  const std::size_t n = scan.ring().size();
  if (scan.xyz_f32().size() != 3 * n * sizeof(float) || scan.intensity().size() != n ||
      scan.time_offset_f32().size() != n * sizeof(float)) {
    return makeError(ErrorCode::Truncated,
                     "LiDAR scan {} of the world: its arrays do not fit {} points", scan.seq(), n);
  }
  auto cloud = std::make_shared<PointCloud>();
  cloud->stamp = shifted(scan.stamp_ns(), shift);
  cloud->seq = scan.seq();
  cloud->frame = frames::kLidar;
  const char* xyz = scan.xyz_f32().data();
  cloud->x = values<float>(xyz, n);
  cloud->y = values<float>(xyz + n * sizeof(float), n);
  cloud->z = values<float>(xyz + 2 * n * sizeof(float), n);
  cloud->intensity = values<std::uint8_t>(scan.intensity().data(), n);
  cloud->ring = values<std::uint8_t>(scan.ring().data(), n);
  cloud->time_offset_s = values<float>(scan.time_offset_f32().data(), n);
  return cloud;
}

Result<ThermalImagePtr> thermalFromProto(const v1::device::ThermalFrame& frame, Duration shift) {
  if (frame.counts_u16().size() != kThermalPixels * sizeof(std::uint16_t) ||
      frame.ffc() > static_cast<std::uint32_t>(FfcState::Complete)) {
    return makeError(ErrorCode::Truncated,
                     "thermal frame {} of the world has {} bytes or shutter state {}", frame.seq(),
                     frame.counts_u16().size(), frame.ffc());
  }
  auto image = std::make_shared<ThermalImage>();
  image->stamp = shifted(frame.stamp_ns(), shift);
  image->seq = frame.seq();
  image->frame_counter = frame.frame_counter();
  image->counts = values<std::uint16_t>(frame.counts_u16().data(), kThermalPixels);
  image->ffc = static_cast<FfcState>(frame.ffc());
  return image;
}

Result<GripperState> gripperFromProto(const v1::device::Report& report, Duration shift) {
  const v1::device::GripperReport& m = report.gripper();
  if (m.current_a_size() != static_cast<int>(kMagnets) || m.on() >> kMagnets != 0)
    return makeError(ErrorCode::Truncated,
                     "gripper report of the world has {} currents and state {:#x}; there are {} "
                     "magnets",
                     m.current_a_size(), m.on(), kMagnets);
  GripperState state;
  state.stamp = shifted(report.now_ns(), shift);
  state.seq = report.seq();
  state.on = MagnetMask(m.on());
  for (int i = 0; i < m.current_a_size(); ++i)
    state.current_a[static_cast<std::size_t>(i)] = m.current_a(i);
  state.contact = m.contact();
  return state;
}

Result<StorageState> storageFromProto(const v1::device::Report& report, Duration shift) {
  StorageState state;
  state.stamp = shifted(report.now_ns(), shift);
  state.seq = report.seq();
  state.setpoint_lost = report.storage().setpoint_lost();
  for (const v1::device::CompartmentReport& m : report.storage().compartments()) {
    if (!std::isfinite(m.position_m()) || !std::isfinite(m.target_m()))
      return makeError(ErrorCode::InvalidInput, "storage report of the world is no number");
    state.compartments.push_back(
        {m.position_m(), m.target_m(), m.current_a(), m.moving(), m.blocked()});
  }
  return state;
}

Result<RgbImagePtr> colourFromProto(const v1::device::ColourFrame& frame, const char* camera,
                                    Duration shift) {
  const std::uint64_t bytes = 3ULL * frame.width() * frame.height();
  if (bytes == 0 || bytes != frame.rgb().size()) {
    return makeError(ErrorCode::Truncated, "picture {} of the world: {} bytes for {} x {}",
                     frame.seq(), frame.rgb().size(), frame.width(), frame.height());
  }
  auto image = std::make_shared<RgbImage>();
  image->stamp = shifted(frame.stamp_ns(), shift);
  image->seq = frame.seq();
  image->frame = camera;
  image->width = static_cast<int>(frame.width());
  image->height = static_cast<int>(frame.height());
  image->data = values<std::uint8_t>(frame.rgb().data(), frame.rgb().size());
  return image;
}

DeviceSet devicesFromProto(const v1::device::HelloReply& reply) {
  DeviceSet out;
  for (const int device : reply.devices()) {
    if (device == v1::device::DEVICE_PUMPS) out.insert(DeviceKind::Pumps);
    if (device == v1::device::DEVICE_LIDAR) out.insert(DeviceKind::Lidar);
    if (device == v1::device::DEVICE_THERMAL_CAMERA) out.insert(DeviceKind::ThermalCamera);
    if (device == v1::device::DEVICE_OPERATOR_CAMERA) out.insert(DeviceKind::OperatorCamera);
    if (device == v1::device::DEVICE_HEAD_CAMERA) out.insert(DeviceKind::HeadCamera);
    if (device == v1::device::DEVICE_GRIPPER) out.insert(DeviceKind::Gripper);
    if (device == v1::device::DEVICE_STORAGE) out.insert(DeviceKind::Storage);
  }
  return out;
}

}  // namespace kiln
