#include "robot/missions/fire/make_fire.h"

#include "robot/missions/fire/fire_mission.h"

namespace kiln {
namespace {

/// Section `fire` of the robot's configuration.
struct FireSection {
  FireConfig mission;
  HeatTask::Config heat;
  void visit(ConfigArchive& a) {
    mission.visit(a);
    a.section("heat", heat, "where the heat is");
  }
};

Result<std::unique_ptr<Mission>> makeFire(const MissionConfig& config,
                                          const std::string& mission_uuid,
                                          const MissionParts& parts) {
  const FireSection& section = static_cast<const MissionConfigOf<FireSection>&>(config).value;
  if (parts.arena.fire_places.empty())
    return makeError(ErrorCode::InvalidInput,
                     "arena '{}' has no fire_places: there is nothing to look for",
                     parts.arena.name);
  auto heat = std::make_unique<HeatTask>(section.heat, parts.executor);
  const FireDevices devices{parts, heat->sweep()};
  return std::make_unique<FireMission>(devices, section.mission, mission_uuid, std::move(heat));
}

}  // namespace

MissionKind fireMissionKind() {
  return {"fire",
          "finds the fire in the kitchen and sprays it",
          "fire",
          "",
          [] { return std::make_unique<MissionConfigOf<FireSection>>(); },
          makeFire};
}

}  // namespace kiln
