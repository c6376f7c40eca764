#pragma once

#include <set>
#include <string_view>

namespace kiln {

/// What one robot has and another lacks. Arm and base are always there.
enum class DeviceKind { Pumps, Lidar, ThermalCamera, OperatorCamera };
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
  }
  return "a device";
}

}  // namespace kiln
