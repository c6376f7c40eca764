#include "robot/missions/fire/make_fire.h"

#include "robot/missions/fire/fire_mission.h"

namespace kiln {
namespace {

/// Section `fire` of the robot's configuration.
struct FireSection {
  FireConfig mission;
  HeatTask::Config heat;
  PlaceTask::Config place;
  std::string spray_calibration = "config/spray_calibration.yaml";
  void visit(ConfigArchive& a) {
    mission.visit(a);
    a.section("heat", heat, "where the heat is");
    a.section("place", place, "where a fire box stands");
    a.field("spray_calibration", spray_calibration,
            "resource file written by kiln-eval spray-calibration");
  }
};

Result<SiteFixtures> fireFixtures(const ArenaMap& arena) {
  const auto site = loadFireSite(arena);
  if (!site) return tl::make_unexpected(site.error());
  return site->fixtures();
}

Result<std::unique_ptr<Mission>> makeFire(const MissionConfig& config,
                                          const std::string& mission_uuid,
                                          const MissionParts& parts) {
  const FireSection& section = static_cast<const MissionConfigOf<FireSection>&>(config).value;
  const auto site = loadFireSite(parts.arena);
  if (!site) return tl::make_unexpected(site.error());
  if (site->places.empty())
    return makeError(ErrorCode::InvalidInput,
                     "arena '{}' has no places of the fire (sites): there is nothing to look for",
                     parts.arena.name);
  const auto spray = loadSprayCalibration(section.spray_calibration);
  if (!spray) return tl::make_unexpected(spray.error());
  FireMission::Perception eyes{
      std::make_unique<HeatTask>(section.heat, parts.executor),
      std::make_unique<PlaceTask>(section.place, *site, parts.scans, parts.executor)};
  const FireDevices devices{parts, eyes.heat->sweep(), *eyes.place, *site, *spray};
  return std::make_unique<FireMission>(devices, section.mission, mission_uuid, std::move(eyes));
}

}  // namespace

MissionKind fireMissionKind() {
  return {"fire",
          "finds the fire in the kitchen and sprays it",
          "fire",
          {},
          [] { return std::make_unique<MissionConfigOf<FireSection>>(); },
          makeFire,
          {DeviceKind::Pumps, DeviceKind::Lidar, DeviceKind::ThermalCamera},
          fireFixtures};
}

}  // namespace kiln
