#pragma once

#include "common/model/handling.h"
#include "common/model/sensor.h"

namespace kiln {

/// The devices as the control loop saw them at one tick, and the odometry made of them: what
/// perception and localisation need, beside the sensors' frames, to be run again on a recording.
struct DeviceSample {
  Stamp stamp;  ///< of the tick
  std::optional<ArmState> arm;
  std::optional<BaseState> base;
  std::optional<PumpsState> pumps;
  std::optional<GripperState> gripper;
  std::optional<StorageState> storage;
  Pose2 X_odom_base;
  Pose2 X_map_odom;          ///< as the localisation of that run had it
  std::uint32_t resets = 0;  ///< counts up when the robot has been carried back
};

}  // namespace kiln
