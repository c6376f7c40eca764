#include "robot/missions/wall/wall_mission.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "robot/missions/wall/wall_machine.h"
#include "robot/missions/wall/wall_view.h"

namespace kiln {

WallMission::WallMission(const MissionParts& parts, const WallConfig& config,
                         const WallSiteMap& site, const WallPlan& plan,
                         const std::string& mission_uuid)
    : context_(parts, config, site, plan), machine_(makeWallMachine(context_, mission_uuid)) {}

void WallMission::beginAnew(Stamp) {
  context_.belief = {};
  context_.siteMoved();
}

void WallMission::onReset(Stamp) {
  context_.halt();
  context_.belief.drive_faults = context_.belief.handling_faults = 0;
}

nlohmann::json WallMission::save() const { return wallBeliefToJson(context_.belief); }

Result<void> WallMission::restore(const nlohmann::json& saved) {
  auto belief = wallBeliefFromJson(saved);
  if (!belief) return tl::make_unexpected(belief.error());
  const std::size_t places = context_.load().storage.load.size();
  const std::size_t bricks = context_.site.layout().slots().size();
  const std::size_t stored = belief->stored + (belief->held && !belief->unloading() ? 1 : 0);
  if (stored > places || (!belief->bricks.empty() && belief->bricks.size() != bricks))
    return makeError(
        ErrorCode::InvalidInput,
        "the checkpoint knows of {} bricks in the pile and {} for the storage, this site "
        "has {} and places for {}: it is of another site or blueprint",
        belief->bricks.size(), stored, bricks, places);
  context_.belief = *belief;
  context_.siteMoved();
  return {};
}

MissionInfo WallMission::info() const { return wall::missionInfo(); }

std::vector<Figure> WallMission::figures(Stamp) const { return wall::figures(context_); }

void WallMission::describe(Scene& scene, Stamp) const { scene.items = wall::sceneItems(context_); }

void WallMission::report(nlohmann::json& report) const {
  const auto pose = [](const Pose2& X) -> nlohmann::json {
    return {{"x_m", X.x_m}, {"y_m", X.y_m}, {"yaw_rad", X.yaw_rad}};
  };
  const auto frame = [&](const std::optional<FoundFrame>& found) -> nlohmann::json {
    if (!found) return nullptr;
    return pose(found->X_map_frame);
  };
  report["stored"] = context_.belief.stored;
  report["built"] = context_.belief.built.size();
  report["map_start"] = pose(context_.parts.arena.start.pose());
  for (const PileBrick& brick : context_.belief.bricks) {
    const Eigen::Vector3d p = brick.X_map_brick.translation();
    report["bricks"].push_back({{"kind", brickShape(brick.kind).name},
                                {"state", toString(brick.state)},
                                {"xyz_m", {p.x(), p.y(), p.z()}},
                                {"confidence", brick.confidence}});
  }
  report["pile"] = frame(context_.belief.pile);
  report["wall"] = frame(context_.belief.wall);
}

namespace {

Result<SiteFixtures> wallFixtures(const ArenaMap& arena) {
  const auto site = loadWallSite(arena);
  if (!site) return tl::make_unexpected(site.error());
  return site->fixtures();
}

Result<std::unique_ptr<Mission>> makeWall(const MissionConfig& config,
                                          const std::string& mission_uuid,
                                          const MissionParts& parts) {
  const WallConfig& wall = static_cast<const MissionConfigOf<WallConfig>&>(config).value;
  const auto site = loadWallSite(parts.arena);
  if (!site) return tl::make_unexpected(site.error());
  if (site->stacks.empty())
    return makeError(ErrorCode::InvalidInput,
                     "arena '{}' has no site of the wall (sites): there is no pile to look for",
                     parts.arena.name);
  const auto plan = planWall(wall, parts.robot);
  if (!plan) return tl::make_unexpected(plan.error());
  return std::make_unique<WallMission>(parts, wall, *site, *plan, mission_uuid);
}

}  // namespace

MissionKind wallMissionKind() {
  return {"wall",
          "finds the pile, loads its bricks and builds the wall of the blueprint at its marker",
          "wall_lab",
          {"name=Mario", "geometry=robot_model/mario.yaml", "arena=config/arena_wall_lab.yaml",
           "localization.method=odometry", "wall.loading.bricks=45", "wall.limit_s=2400"},
          [] { return std::make_unique<MissionConfigOf<WallConfig>>(); },
          makeWall,
          {DeviceKind::Lidar, DeviceKind::HeadCamera, DeviceKind::Gripper, DeviceKind::Storage},
          wallFixtures};
}

}  // namespace kiln
