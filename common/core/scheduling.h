#pragma once

#include <optional>

namespace kiln {

/// Priority for SCHED_RR, if this process has the right to it (CAP_SYS_NICE, or the limit
/// `rtprio`); nullopt else, which is logged once: everything works then, but late on a busy
/// machine. Thread-safe.
[[nodiscard]] std::optional<int> realtimePriority();

/// The calling thread, and each that it starts from now on, runs before all ordinary ones, where
/// that is allowed. For threads that others wait for with a deadline: devices, control, STOP.
void runBeforeOthers();

/// The calling thread runs when nobody else wants to: for work that may be late.
void runAfterOthers();

}  // namespace kiln
