#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "common/core/stamp.h"

namespace kiln {

/// Poles of the gripper, each switched by itself.
inline constexpr std::size_t kGripperPoles = 8;
using GripperPoles = std::bitset<kGripperPoles>;

struct GripperState {
  Stamp stamp;
  std::uint64_t seq = 0;
  GripperPoles on;                                ///< as commanded
  std::array<double, kGripperPoles> current_a{};  ///< measured; one without current holds nothing
  bool contact = false;                           ///< the switch in the face: something presses
};

struct CompartmentState {
  double position_m = 0.0;  ///< along its travel, measured
  double target_m = 0.0;    ///< as commanded
  double current_a = 0.0;   ///< of its drive
  bool moving = false;
  bool blocked = false;  ///< pushed and did not move: it rests until another target comes
};

struct StorageState {
  Stamp stamp;
  std::uint64_t seq = 0;
  std::vector<CompartmentState> compartments;  ///< as in RobotGeometry::storage
  bool setpoint_lost = false;                  ///< they stopped because no target came
};

}  // namespace kiln
