#pragma once

#include <string>
#include <string_view>

#include "common/core/error.h"

/// Recordings of protocol 1 and 2, in which the core's messages carried the fire mission, as
/// messages of today. What is no fire mission's stays as it is. Decoders answer corrupt input with
/// an Error.
namespace kiln::wire::protocol2 {

/// RobotStatus: tanks, pumps and score become figures.
[[nodiscard]] Result<std::string> upgradeStatus(std::string_view bytes);
/// Scene: places, estimates and jet become items and a detail.
[[nodiscard]] Result<std::string> upgradeScene(std::string_view bytes);
/// MacroList: litres become text.
[[nodiscard]] Result<std::string> upgradeMacros(std::string_view bytes);
/// HeatDetections, on a topic of its own then, as a MissionDetail.
[[nodiscard]] Result<std::string> upgradeHeat(std::string_view bytes);
/// The MissionInfo that a mission would have told, from its FsmInfo.
[[nodiscard]] Result<std::string> missionInfo(std::string_view fsm_info);

}  // namespace kiln::wire::protocol2
