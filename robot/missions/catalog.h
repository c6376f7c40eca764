#pragma once

#include <string>
#include <vector>

#include "robot/missions/common/mission_kind.h"

namespace kiln {

[[nodiscard]] const std::vector<MissionKind>& missionKinds();
/// nullptr: there is none of that name.
[[nodiscard]] const MissionKind* findMission(const std::string& name);
/// Every mission's section with its defaults.
[[nodiscard]] MissionConfigs missionConfigs();
/// "fire: ...; mapping: ..." for a help text.
[[nodiscard]] std::string missionHelp();
[[nodiscard]] std::vector<std::string> missionNames();

}  // namespace kiln
