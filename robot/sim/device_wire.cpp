#include "robot/sim/device_wire.h"

#include "common/geom/frames.h"

namespace kiln::sim {
namespace {

template <class T>
std::string bytes(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void writeLidar(const PointCloud& scan, v1::device::LidarScan& m) {
  m.set_stamp_ns(toNanoseconds(scan.stamp));
  m.set_seq(scan.seq);
  std::string xyz;
  xyz.reserve(3 * scan.size() * sizeof(float));
  for (const auto* axis : {&scan.x, &scan.y, &scan.z}) xyz += bytes(*axis);
  m.set_xyz_f32(std::move(xyz));
  m.set_intensity(bytes(scan.intensity));
  m.set_ring(bytes(scan.ring));
  m.set_time_offset_f32(bytes(scan.time_offset_s));
}

void writeThermal(const ThermalImage& image, v1::device::ThermalFrame& m) {
  m.set_stamp_ns(toNanoseconds(image.stamp));
  m.set_seq(image.seq);
  m.set_frame_counter(image.frame_counter);
  m.set_counts_u16(bytes(image.counts));
  m.set_ffc(static_cast<std::uint32_t>(image.ffc));
}

void writeColour(const RgbImage& image, v1::device::ColourFrame& m) {
  m.set_stamp_ns(toNanoseconds(image.stamp));
  m.set_seq(image.seq);
  m.set_width(static_cast<std::uint32_t>(image.width));
  m.set_height(static_cast<std::uint32_t>(image.height));
  m.set_rgb(bytes(image.data));
}

void writeGripper(const GripperState& state, v1::device::GripperReport& m) {
  m.set_on(static_cast<std::uint32_t>(state.on.to_ulong()));
  for (const double current : state.current_a) m.add_current_a(current);
  m.set_contact(state.contact);
}

void writeStorage(const StorageState& state, v1::device::StorageReport& m) {
  for (const CompartmentState& from : state.compartments) {
    v1::device::CompartmentReport& to = *m.add_compartments();
    to.set_position_m(from.position_m);
    to.set_target_m(from.target_m);
    to.set_current_a(from.current_a);
    to.set_moving(from.moving);
    to.set_blocked(from.blocked);
  }
  m.set_setpoint_lost(state.setpoint_lost);
}

}  // namespace

Result<WorldCommands> fromProto(const v1::device::Advance& m) {
  WorldCommands c;
  if (m.has_arm()) {
    if (m.arm().q_rad_size() != 6 || m.arm().qd_radps_size() != 6) {
      return makeError(ErrorCode::Truncated,
                       "arm command has {} positions and {} speeds; it needs 6 of each",
                       m.arm().q_rad_size(), m.arm().qd_radps_size());
    }
    c.arm.emplace();
    for (int i = 0; i < 6; ++i) {
      c.arm->q[i] = m.arm().q_rad(i);
      c.arm->qd[i] = m.arm().qd_radps(i);
    }
    if (m.arm().sent_ns() != 0) c.arm_sent = stampFromNanoseconds(m.arm().sent_ns());
  }
  if (m.has_base()) {
    if (m.base().wheels_size() != 4) {
      return makeError(ErrorCode::Truncated, "base command has {} wheels; it needs 4",
                       m.base().wheels_size());
    }
    c.base.emplace();
    for (int i = 0; i < 4; ++i) {
      (*c.base)[static_cast<std::size_t>(i)] = {m.base().wheels(i).steer_rad(),
                                                m.base().wheels(i).drive_radps()};
    }
  }
  if (m.has_pumps()) c.pumps = {m.pumps().left(), m.pumps().right()};
  if (m.has_sensors()) {
    c.sensors = SensorRequest{m.sensors().lidar(), m.sensors().thermal(),
                              m.sensors().operator_camera(), m.sensors().head_camera()};
  }
  if (m.has_magnets()) {
    if (m.magnets().on() >> kMagnets != 0)
      return makeError(ErrorCode::InvalidInput, "magnets {:#x}: there are {}", m.magnets().on(),
                       kMagnets);
    c.magnets = MagnetMask(m.magnets().on());
  }
  if (m.has_storage())
    c.storage.emplace(m.storage().position_m().begin(), m.storage().position_m().end());
  if (m.has_payload()) {
    if (m.payload().com_m_size() != 3) {
      return makeError(ErrorCode::Truncated, "payload has a centre of {} numbers; it needs 3",
                       m.payload().com_m_size());
    }
    c.payload = ArmPayload{m.payload().mass_kg(),
                           {m.payload().com_m(0), m.payload().com_m(1), m.payload().com_m(2)}};
  }
  c.zero_force = m.zero_force();
  c.start_clock = m.start_clock();
  c.release_protective_stop = m.release_protective_stop();
  c.request_reset = m.request_reset();
  return c;
}

void toProto(const WorldReport& report, v1::device::Report& m) {
  m.set_now_ns(toNanoseconds(report.now));
  m.set_seq(report.seq);
  m.set_slipped_ns(report.slipped.count());
  for (int i = 0; i < 6; ++i) {
    m.mutable_arm()->add_q_rad(report.arm.q[i]);
    m.mutable_arm()->add_qd_radps(report.arm.qd[i]);
    m.mutable_arm()->add_wrench(report.arm.wrench_tool[i]);
  }
  m.mutable_arm()->set_safety(static_cast<std::uint32_t>(report.arm.safety));
  m.mutable_arm()->set_powered(report.arm.powered);
  for (const WheelState& wheel : report.base.wheels) {
    v1::device::Wheel* out = m.mutable_base()->add_wheels();
    out->set_steer_rad(wheel.steer_rad);
    out->set_drive_radps(wheel.drive_radps);
    out->set_drive_angle_rad(wheel.drive_angle_rad);
    out->set_drive_current_a(wheel.drive_current_a);
  }
  m.mutable_base()->set_battery_v(report.base.battery_v);
  m.mutable_base()->set_battery_a(report.base.battery_a);
  for (std::size_t i = 0; i < 2; ++i) {
    m.mutable_pumps()->add_duty(report.pumps.duty[i]);
    m.mutable_pumps()->add_current_a(report.pumps.current_a[i]);
  }
  m.mutable_pumps()->set_contact_switch(report.pumps.contact_switch);
  m.mutable_pumps()->set_heartbeat_lost(report.pumps.heartbeat_lost);
  for (const PointCloudPtr& scan : report.lidar) writeLidar(*scan, *m.add_lidar());
  for (const ThermalImagePtr& image : report.thermal) writeThermal(*image, *m.add_thermal());
  for (const RgbImagePtr& image : report.colour)
    writeColour(*image, image->frame == frames::kRgb ? *m.add_head_colour() : *m.add_colour());
  if (report.gripper) writeGripper(*report.gripper, *m.mutable_gripper());
  if (report.storage) writeStorage(*report.storage, *m.mutable_storage());
  m.set_resets(report.resets);
  m.set_refused(report.refused);
}

v1::device::Device toProto(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::Pumps:
      return v1::device::DEVICE_PUMPS;
    case DeviceKind::Lidar:
      return v1::device::DEVICE_LIDAR;
    case DeviceKind::ThermalCamera:
      return v1::device::DEVICE_THERMAL_CAMERA;
    case DeviceKind::OperatorCamera:
      return v1::device::DEVICE_OPERATOR_CAMERA;
    case DeviceKind::HeadCamera:
      return v1::device::DEVICE_HEAD_CAMERA;
    case DeviceKind::Gripper:
      return v1::device::DEVICE_GRIPPER;
    case DeviceKind::Storage:
      return v1::device::DEVICE_STORAGE;
  }
  return v1::device::DEVICE_UNSPECIFIED;
}

void leaveOut(const DeviceSet& devices, v1::device::Report& report) {
  if (!devices.contains(DeviceKind::Pumps)) report.clear_pumps();
  if (!devices.contains(DeviceKind::Gripper)) report.clear_gripper();
  if (!devices.contains(DeviceKind::Storage)) report.clear_storage();
}

void leaveOut(const DeviceSet& devices, WorldCommands& commands) {
  if (!devices.contains(DeviceKind::Pumps)) commands.pumps.reset();
  if (!devices.contains(DeviceKind::Gripper)) commands.magnets.reset();
  if (!devices.contains(DeviceKind::Storage)) commands.storage.reset();
  if (!commands.sensors) return;
  commands.sensors->lidar &= devices.contains(DeviceKind::Lidar);
  commands.sensors->thermal &= devices.contains(DeviceKind::ThermalCamera);
  commands.sensors->operator_camera &= devices.contains(DeviceKind::OperatorCamera);
  commands.sensors->head_camera &= devices.contains(DeviceKind::HeadCamera);
}

}  // namespace kiln::sim
