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
};

}  // namespace kiln
