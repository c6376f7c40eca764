#pragma once

#include <array>
#include <optional>
#include <set>
#include <string_view>

namespace kiln {

/// What one robot has and another lacks. Arm and base are always there.
enum class DeviceKind { Pumps, Lidar, ThermalCamera, OperatorCamera, HeadCamera, Gripper, Storage };
using DeviceSet = std::set<DeviceKind>;

/// For operators: "a thermal camera".
[[nodiscard]] constexpr std::string_view toString(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::Pumps:
      return "pumps";
    case DeviceKind::Lidar:
      return "a LiDAR";
    case DeviceKind::ThermalCamera:
      return "a thermal camera";
    case DeviceKind::OperatorCamera:
      return "an operator camera";
    case DeviceKind::HeadCamera:
      return "a head camera";
    case DeviceKind::Gripper:
      return "a gripper";
    case DeviceKind::Storage:
      return "a storage";
  }
  return "a device";
}

/// For command lines and files: "thermal".
[[nodiscard]] constexpr std::string_view shortName(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::Pumps:
      return "pumps";
    case DeviceKind::Lidar:
      return "lidar";
    case DeviceKind::ThermalCamera:
      return "thermal";
    case DeviceKind::OperatorCamera:
      return "camera";
    case DeviceKind::HeadCamera:
      return "head-camera";
    case DeviceKind::Gripper:
      return "gripper";
    case DeviceKind::Storage:
      return "storage";
  }
  return "";
}

inline constexpr std::array kDeviceKinds{DeviceKind::Pumps,         DeviceKind::Lidar,
                                         DeviceKind::ThermalCamera, DeviceKind::OperatorCamera,
                                         DeviceKind::HeadCamera,    DeviceKind::Gripper,
                                         DeviceKind::Storage};

/// By its short name; nullopt: no such device.
[[nodiscard]] constexpr std::optional<DeviceKind> deviceNamed(std::string_view name) {
  for (const DeviceKind kind : kDeviceKinds)
    if (shortName(kind) == name) return kind;
  return std::nullopt;
}

}  // namespace kiln
