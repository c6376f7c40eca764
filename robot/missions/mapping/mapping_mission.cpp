#include "robot/missions/mapping/mapping_mission.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "common/core/units.h"
#include "robot/missions/mapping/mapping_machine.h"

namespace kiln {

void MappingConfig::visit(ConfigArchive& a) {
  a.field("stow_tolerance_deg", stow_tolerance_deg, "deg", 0.1, 20.0,
          "arm counts as in its drive pose");
  a.field("rest_s", rest_s, "s", 0.0, 30.0, "before a drive is tried once more");
  a.field("max_faults", max_faults, "", 0, 10, "retries of the whole round");
  a.field("limit_s", limit_s, "s", 60.0, 36000.0, "mission clock, for the operator");
}

MappingMission::MappingMission(const MappingConfig& config, const std::string& mission_uuid,
                               const MissionParts& parts)
    : limit_s_(config.limit_s),
      drive_(parts, config.stow_tolerance_deg * kDeg),
      context_{parts.clock, parts.arena, drive_, parts.pose, config.rest_s, config.max_faults},
      machine_(makeMappingMachine(context_, mission_uuid)) {}

void MappingMission::beginAnew(Stamp) {
  context_.passed = 0;
  context_.faults = 0;
}

void MappingMission::onReset(Stamp) {
  context_.passed = 0;
  drive_.cancel();
}

nlohmann::json MappingMission::save() const {
  return {{"passed", context_.passed}, {"faults", context_.faults}};
}

Result<void> MappingMission::restore(const nlohmann::json& saved) {
  try {
    const auto passed = saved.at("passed").get<std::int64_t>();
    const int faults = saved.at("faults").get<int>();
    const auto length = static_cast<std::int64_t>(context_.arena.mapping_path.size());
    if (passed < 0 || passed > length || faults < 0)
      return makeError(ErrorCode::InvalidInput, "way-point {} of {} was passed, {} faults", passed,
                       length, faults);
    context_.passed = static_cast<std::size_t>(passed);
    context_.faults = faults;
  } catch (const nlohmann::json::exception& e) {
    return makeError(ErrorCode::InvalidInput, "how far the round was driven is damaged: {}",
                     e.what());
  }
  return {};
}

MissionKind mappingMissionKind() {
  const auto make = [](const MissionConfig& config, const std::string& mission_uuid,
                       const MissionParts& parts) -> Result<std::unique_ptr<Mission>> {
    if (parts.arena.mapping_path.empty())
      return makeError(ErrorCode::InvalidInput,
                       "arena '{}' has no mapping_path: there is no round to drive",
                       parts.arena.name);
    return std::make_unique<MappingMission>(
        static_cast<const MissionConfigOf<MappingConfig>&>(config).value, mission_uuid, parts);
  };
  return {"mapping",
          "drives a round to record for kiln-eval map (locates by walls, needs no map)",
          "fire",
          {"localization.method=walls"},
          [] { return std::make_unique<MissionConfigOf<MappingConfig>>(); },
          make,
          {DeviceKind::Lidar}};
}

}  // namespace kiln
