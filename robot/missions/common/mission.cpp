#include "robot/missions/common/mission.h"

namespace kiln {

// The defaults of a mission that has nothing to say.

MissionInfo Mission::info() const { return {}; }
Result<void> Mission::command(const MissionCommand& command, const std::string&, Stamp) {
  return makeError(ErrorCode::Refused, "this mission does not know {}", command.name);
}

MacroStepKinds Mission::macroSteps(const MacroConfig&) const { return {}; }
std::optional<Pose2> Mission::workPose(const std::string&) const { return std::nullopt; }
std::vector<MissionAlarm> Mission::alarms(Stamp) const { return {}; }
std::vector<Check> Mission::checks(Stamp) const { return {}; }
std::vector<Figure> Mission::figures(Stamp) const { return {}; }
void Mission::describe(Scene&, Stamp) const {}
void Mission::report(nlohmann::json&) const {}
void Mission::onThermal(ThermalImagePtr) {}
void Mission::onPicture(RgbImagePtr) {}

}  // namespace kiln
