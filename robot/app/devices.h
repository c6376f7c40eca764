#pragma once

#include "robot/hal/arena.h"
#include "robot/hal/arm.h"
#include "robot/hal/drive_base.h"
#include "robot/hal/lidar.h"
#include "robot/hal/pumps.h"
#include "robot/hal/rgb_camera.h"
#include "robot/hal/thermal_camera.h"

namespace kiln {

/// The devices that one robot is made of, wherever they come from (simulator, drivers, recorded
/// files). Nothing is owned; sensors may be missing.
struct Devices {
  Arm& arm;
  DriveBase& base;
  Pumps& pumps;
  Arena& arena;
  Lidar* lidar = nullptr;
  ThermalCamera* thermal = nullptr;
  RgbCamera* operator_camera = nullptr;
  std::function<bool()> connected = [] { return false; };
  /// How often the robot was carried back; nullopt: not heard yet.
  std::function<std::optional<std::uint32_t>()> resets = [] { return std::optional(0U); };
};

}  // namespace kiln
