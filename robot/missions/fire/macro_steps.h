#pragma once

#include "robot/missions/fire/fire_context.h"
#include "robot/skills/macro_steps.h"

namespace kiln {

/// The kinds of macro steps that the fire mission brings:
///   nozzle  as `tool`: the nozzle is the tool
///   aim     place, standoff_m: nozzle before a fire place so that the jet passes its opening
///   spray   duty, seconds, pattern: steady | hourglass, tilt_deg
/// They work by the arena's configured plate and the robot's present pose: no heat estimate is
/// needed, which is what makes them a fallback. @param context  outlives them.
[[nodiscard]] MacroStepKinds fireMacroSteps(const FireContext& context, const MacroConfig& config);

}  // namespace kiln
