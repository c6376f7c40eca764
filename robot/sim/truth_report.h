#pragma once

#include <string>

#include "common/core/error.h"
#include "robot/sim/world.h"

namespace kiln::sim {

/// The truth as JSON, two-space indent, keys in a fixed order, no wall time: the same run gives the
/// same text.
[[nodiscard]] std::string truthJson(const Truth& truth);
/// One line of the trace: t, base pose, thermal camera pose, nozzle pose, joint angles, jet.
[[nodiscard]] std::string truthTraceLine(const Truth& truth);
/// Writes to PATH.tmp, flushes to disk, renames. Error: Storage, with the path.
[[nodiscard]] Result<void> writeAtomically(const std::string& path, const std::string& text);

}  // namespace kiln::sim
