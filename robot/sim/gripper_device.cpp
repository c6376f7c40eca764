#include "robot/sim/gripper_device.h"

#include <algorithm>

namespace kiln::sim {

GripperDevice::GripperDevice(const MagnetConfig& config, std::uint64_t seed)
    : config_(config), noise_(seed, "magnet current") {}

void GripperDevice::write(const MagnetMask& on) {
  if (powered_) on_ = on;
}

void GripperDevice::setPowered(bool powered) {
  powered_ = powered;
  if (!powered) on_.reset();
}

void GripperDevice::step(double step_s) {
  const double share = std::min(1.0, step_s / config_.rise_s);
  for (std::size_t i = 0; i < kMagnets; ++i)
    fields_[i] += share * ((on_[i] && !broken_[i] ? 1.0 : 0.0) - fields_[i]);
}

GripperState GripperDevice::report(Stamp now, bool contact) {
  GripperState state;
  state.stamp = now;
  state.on = on_;
  state.contact = contact;
  for (std::size_t i = 0; i < kMagnets; ++i)
    state.current_a[i] = std::max(0.0, config_.current_a * (on_[i] && !broken_[i] ? 1.0 : 0.0) +
                                           noise_.normal(config_.current_noise_a));
  return state;
}

}  // namespace kiln::sim
