#pragma once

#include <optional>
#include <span>

#include "common/core/error.h"
#include "common/model/handling.h"

namespace kiln {

/// Compartments that travel sideways (paper, "Storage System"). Device fail-safe: 250 ms after the
/// last target each of them stops where it is. Thread-safe.
class Storage {
 public:
  virtual ~Storage() = default;
  [[nodiscard]] virtual std::optional<StorageState> state() const = 0;
  /// Targets of all compartments; written at 20 Hz or faster while any is to move.
  /// Error: InvalidInput for a number that is not finite.
  virtual Result<void> write(std::span<const double> targets_m) = 0;
};

}  // namespace kiln
