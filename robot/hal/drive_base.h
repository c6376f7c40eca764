#pragma once

#include <array>
#include <optional>

#include "common/core/error.h"
#include "common/model/sensor.h"

namespace kiln {

struct WheelCommand {
  double steer_rad = 0.0;  ///< +-pi
  double drive_radps = 0.0;
};
/// Order as in BaseState.
using WheelCommands = std::array<WheelCommand, 4>;

/// Four steered hub wheels. Device fail-safe: wheels brake 250 ms after the last command.
/// Thread-safe.
class DriveBase {
 public:
  virtual ~DriveBase() = default;
  [[nodiscard]] virtual std::optional<BaseState> state() const = 0;
  /// @pre all finite.
  virtual Result<void> write(const WheelCommands& command) = 0;
};

}  // namespace kiln
