#pragma once

#include <array>

#include "robot/hal/gripper.h"
#include "robot/sim/random.h"
#include "robot/sim/wall_config.h"

namespace kiln::sim {

/// The Nano's eight magnets and the contact switch. Magnets keep their state whatever happens on
/// the link; without power they are off, and stay off until they are switched on again.
/// Thread-compatible.
class GripperDevice {
 public:
  GripperDevice(const MagnetConfig& config, std::uint64_t seed);

  void write(const MagnetMask& on);
  void setPowered(bool powered);
  /// A coil that is broken takes no current.
  void setBroken(std::size_t magnet, bool broken) { broken_[magnet] = broken; }
  void step(double step_s);
  /// 0 to 1, by magnet.
  [[nodiscard]] const std::array<double, kMagnets>& fields() const { return fields_; }
  [[nodiscard]] GripperState report(Stamp now, bool contact);

 private:
  MagnetConfig config_;
  Random noise_;
  MagnetMask on_, broken_;
  bool powered_ = true;
  std::array<double, kMagnets> fields_{};
};

}  // namespace kiln::sim
