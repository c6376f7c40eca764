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
/// Puts into the arena what the missions' sites bring, whichever mission will run.
/// Errors: a site of a mission that is not in the catalogue, or what is wrong with its file.
[[nodiscard]] Result<void> furnish(ArenaMap& arena);

}  // namespace kiln
