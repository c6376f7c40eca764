#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "common/core/error.h"
#include "common/model/handling.h"

namespace kiln {

inline constexpr std::size_t kMagnets = kGripperPoles;
using MagnetMask = GripperPoles;

/// Middles of the poles on the face of the head, in `tool` (z = 0): two rows of four along X, the
/// row at -Y first, each from -X.
[[nodiscard]] inline std::array<Eigen::Vector2d, kMagnets> magnetPositions() {
  constexpr double kPitch_m = 0.045, kRow_m = 0.04;
  std::array<Eigen::Vector2d, kMagnets> out;
  for (std::size_t i = 0; i < kMagnets; ++i)
    out[i] = {(static_cast<double>(i % 4) - 1.5) * kPitch_m, i < 4 ? -kRow_m : kRow_m};
  return out;
}

/// Eight electromagnets and a contact switch behind the Nano (paper, "Multi Purpose End-effector").
/// Device fail-safe: the magnets keep their state on STOP and on a lost link, because a brick that
/// falls is worse; without power they are off, and stay off when it comes back. Thread-safe.
class Gripper {
 public:
  virtual ~Gripper() = default;
  [[nodiscard]] virtual std::optional<GripperState> state() const = 0;
  virtual Result<void> write(const MagnetMask& on) = 0;
};

}  // namespace kiln
