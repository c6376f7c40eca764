#pragma once

#include <optional>

#include "common/model/status.h"
#include "robot/hal/arm.h"
#include "robot/hal/drive_base.h"
#include "robot/hal/pumps.h"

namespace kiln {

/// What stands still by what was measured just now, each subsystem by its own device: a state that
/// is older than 0.1 s, from the future, or no number proves nothing. Fills arm_at_rest,
/// base_at_rest, pumps_at_rest, and standstill_proven of a latched STOP.
void proveStandstill(StopStatus& status, const std::optional<ArmState>& arm,
                     const std::optional<BaseState>& base, const std::optional<PumpsState>& pumps,
                     Stamp now);

/// How the base moves by its wheels; NaN when they have not reported for 0.1 s: an old speed is
/// none.
/// @param measured  of the newest report.
[[nodiscard]] Twist2 knownTwist(const Twist2& measured, const std::optional<BaseState>& base,
                                Stamp now);

/// A number of the base's newest report; NaN when it has not reported for 0.1 s.
[[nodiscard]] double knownOf(const std::optional<BaseState>& base, double BaseState::*number,
                             Stamp now);

}  // namespace kiln
