#pragma once

#include <array>
#include <optional>

#include "common/core/error.h"
#include "common/model/sensor.h"

namespace kiln {

/// Two water pumps behind the Nano. Device fail-safe: 200 ms after the last heartbeat the firmware
/// cuts both pumps. There is no flow or level sensor; the motor current is measured. Thread-safe.
class Pumps {
 public:
  virtual ~Pumps() = default;
  [[nodiscard]] virtual std::optional<PumpsState> state() const = 0;
  /// Sets both duties (0..1) and feeds the heartbeat; called at 20 Hz or faster, also with zeros.
  virtual Result<void> write(const std::array<double, 2>& duty) = 0;
};

}  // namespace kiln
