#pragma once

#include "robot/hal/arena.h"
#include "robot/hal/arm.h"
#include "robot/hal/device_set.h"
#include "robot/hal/drive_base.h"
#include "robot/hal/gripper.h"
#include "robot/hal/lidar.h"
#include "robot/hal/pumps.h"
#include "robot/hal/rgb_camera.h"
#include "robot/hal/storage.h"
#include "robot/hal/thermal_camera.h"

namespace kiln {

/// The devices that one robot is made of, wherever they come from (simulator, drivers, recorded
/// files). Nothing is owned; arm and base are always there, what is nullptr this robot lacks.
struct Devices {
  Arm& arm;
  DriveBase& base;
  Pumps* pumps = nullptr;
  Arena* arena = nullptr;
  Lidar* lidar = nullptr;
  ThermalCamera* thermal = nullptr;
  RgbCamera* operator_camera = nullptr;
  RgbCamera* head_camera = nullptr;
  Gripper* gripper = nullptr;
  Storage* storage = nullptr;
  std::function<bool()> connected = [] { return false; };
  /// How often the robot was carried back; nullopt: not heard yet.
  std::function<std::optional<std::uint32_t>()> resets = [] { return std::optional(0U); };

  [[nodiscard]] DeviceSet present() const {
    DeviceSet out;
    if (pumps != nullptr) out.insert(DeviceKind::Pumps);
    if (lidar != nullptr) out.insert(DeviceKind::Lidar);
    if (thermal != nullptr) out.insert(DeviceKind::ThermalCamera);
    if (operator_camera != nullptr) out.insert(DeviceKind::OperatorCamera);
    if (head_camera != nullptr) out.insert(DeviceKind::HeadCamera);
    if (gripper != nullptr) out.insert(DeviceKind::Gripper);
    if (storage != nullptr) out.insert(DeviceKind::Storage);
    return out;
  }
};

}  // namespace kiln
