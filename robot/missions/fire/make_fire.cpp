#include "robot/missions/fire/make_fire.h"

#include "robot/missions/fire/fire_mission.h"

namespace kiln {
namespace {

/// Section `fire` of the robot's configuration.
struct FireSection {
  FireConfig mission;
  HeatTask::Config heat;
  std::string spray_calibration = "config/spray_calibration.yaml";
  void visit(ConfigArchive& a) {
    mission.visit(a);
    a.section("heat", heat, "where the heat is");
    a.field("spray_calibration", spray_calibration,
            "resource file written by kiln-eval spray-calibration");
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
  const auto spray = loadSprayCalibration(section.spray_calibration);
  if (!spray) return tl::make_unexpected(spray.error());
  auto heat = std::make_unique<HeatTask>(section.heat, parts.executor);
  const FireDevices devices{parts, heat->sweep(), *spray};
  return std::make_unique<FireMission>(devices, section.mission, mission_uuid, std::move(heat));
}

}  // namespace

MissionKind fireMissionKind() {
  return {"fire",
          "finds the fire in the kitchen and sprays it",
          "fire",
          "",
          [] { return std::make_unique<MissionConfigOf<FireSection>>(); },
          makeFire,
          {DeviceKind::Pumps, DeviceKind::Lidar, DeviceKind::ThermalCamera}};
}

}  // namespace kiln
