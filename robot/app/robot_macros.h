#pragma once

#include <string>
#include <vector>

#include "robot/missions/common/mission.h"
#include "robot/skills/macro.h"
#include "robot/skills/macro_steps.h"
#include "robot/skills/move_arm.h"

namespace kiln {

/// The macros of every robot (resources/macros) and those of its mission (resources/macros/NAME).
/// @param arm  outlives them, and so does the mission. Error: a file that is wrong, by name and
/// line.
[[nodiscard]] Result<std::vector<Macro>> robotMacros(const RobotGeometry& robot, MoveArm& arm,
                                                     const MacroConfig& config,
                                                     const Mission& mission,
                                                     const std::string& mission_name);

}  // namespace kiln
