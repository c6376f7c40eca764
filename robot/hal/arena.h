#pragma once

#include "common/core/error.h"

namespace kiln {

/// The people around the robot. A competition reset means that they carry it back to its start with
/// the arm in its park pose; the robot only learns that it happened (odometry starts at zero). In
/// the simulator the referee does it; on the real robot this waits for the operator's confirmation.
class Arena {
 public:
  virtual ~Arena() = default;
  virtual Result<void> requestReset() = 0;
  /// The mission's clock runs: the fire is lit. Said again (each tick, after a resume or a reset)
  /// it changes nothing.
  virtual Result<void> startClock() = 0;
};

}  // namespace kiln
