#include "gui/views/scene3d/scene_state.h"

#include <algorithm>
#include <cmath>

#include "common/geom/frames.h"

namespace kiln::gui {
namespace {

bool finite(const Pose2& X) {
  return std::isfinite(X.x_m) && std::isfinite(X.y_m) && std::isfinite(X.yaw_rad);
}

bool sameBoxes(const std::vector<SceneBox>& a, const std::vector<SceneBox>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const SceneBox& p, const SceneBox& q) {
                      return p.name == q.name && p.rgb == q.rgb && p.half_extent == q.half_extent &&
                             p.X_map_box.matrix() == q.X_map_box.matrix();
                    });
}

}  // namespace

const char* toString(SceneLayer layer) {
  switch (layer) {
    case SceneLayer::Robot:
      return "Robot";
    case SceneLayer::Lidar:
      return "LiDAR";
    case SceneLayer::Map:
      return "Map points";
    case SceneLayer::Walls:
      return "Nominal walls";
    case SceneLayer::Planned:
      return "Planned path";
    case SceneLayer::Driven:
      return "Driven path";
  }
  return "?";
}

void SceneState::touch(SceneLayer l) { ++layer(l).revision; }

void SceneState::setStatus(const RobotStatus& status) {
  if (!finite(status.X_map_base) || !status.arm.q.allFinite()) return;
  snapshot_.robot_known = true;
  snapshot_.X_map_base = status.X_map_base;
  snapshot_.q = status.arm.q;
  snapshot_.steer = status.wheel_steer_rad;
  poses_.push_back({status.stamp, snapshot_.robotPose(), status.arm.q});
  while (poses_.size() > config_.pose_history) poses_.pop_front();
  touch(SceneLayer::Robot);
  extendTrail(status);
  if (cloud_waits_) setCloud(snapshot_.cloud);
}

void SceneState::extendTrail(const RobotStatus& status) {
  auto& lines = snapshot_.driven;
  if (lines.empty() || status.resets != resets_) lines.emplace_back();
  resets_ = status.resets;
  const Eigen::Vector2d p(status.X_map_base.x_m, status.X_map_base.y_m);
  if (!lines.back().empty() && (p - lines.back().back()).norm() < config_.trail_step_m) return;
  lines.back().push_back(p);
  trimTrail();
  touch(SceneLayer::Driven);
}

void SceneState::trimTrail() {
  auto& lines = snapshot_.driven;
  std::size_t total = 0;
  for (const auto& line : lines) total += line.size();
  if (total <= config_.trail_points) return;
  auto& oldest = lines.front();
  oldest.erase(oldest.begin(), oldest.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                    oldest.size(), total - config_.trail_points)));
  if (oldest.empty() && lines.size() > 1) lines.erase(lines.begin());
}

const SceneState::PoseAt* SceneState::poseNear(Stamp stamp) const {
  const auto nearer = [stamp](const PoseAt& a, const PoseAt& b) {
    return std::chrono::abs(a.stamp - stamp) < std::chrono::abs(b.stamp - stamp);
  };
  const auto best = std::min_element(poses_.begin(), poses_.end(), nearer);
  return best == poses_.end() ? nullptr : &*best;
}

void SceneState::setCloud(PointCloudPtr cloud) {
  if (!cloud) {  // nothing to see at the time that a recording jumped to
    snapshot_.cloud.reset();
    cloud_waits_ = false;
    touch(SceneLayer::Lidar);
    return;
  }
  const PoseAt* at = poseNear(cloud->stamp);
  cloud_waits_ = !at && cloud->frame != frames::kMap;
  Eigen::Isometry3d X_map_cloud = Eigen::Isometry3d::Identity();
  if (cloud->frame == frames::kBase || cloud->frame == frames::kLidar) {
    // Without a robot pose the scan is still worth seeing, round the origin (sensor files have no
    // robot).
    if (at) X_map_cloud = at->X_map_base;
    if (cloud->frame == frames::kLidar) {
      const Vector6d q = at ? at->q : RobotGeometry::radians(geometry_.q_drive_deg);
      X_map_cloud = X_map_cloud * geometry_.X_base_flange(q) * geometry_.X_flange_lidar.pose();
    }
  } else if (cloud->frame != frames::kMap) {
    cloud_refusal_ = "LiDAR not drawn: its frame '" + cloud->frame + "' is not map, base or lidar";
    return;
  }
  cloud_refusal_.clear();
  snapshot_.X_map_cloud = X_map_cloud;
  snapshot_.cloud = std::move(cloud);
  touch(SceneLayer::Lidar);
}

void SceneState::setScene(const Scene& scene) {
  if (!sameBoxes(snapshot_.arena, scene.arena)) {
    snapshot_.arena = scene.arena;
    touch(SceneLayer::Walls);
  }
  snapshot_.planned = scene.planned;
  snapshot_.items = scene.items;
  touch(SceneLayer::Planned);
  ++snapshot_.items_revision;
}

void SceneState::setMission(const MissionInfo& info) {
  std::vector<MissionLayer> layers;
  for (const LayerSpec& spec : info.layers) layers.push_back({spec, snapshot_.layer(spec.id)});
  snapshot_.mission_layers = std::move(layers);
  ++snapshot_.items_revision;
}

const LayerState& SceneSnapshot::layer(const std::string& mission_layer) const {
  static const LayerState kShown;
  const auto found =
      std::find_if(mission_layers.begin(), mission_layers.end(),
                   [&](const MissionLayer& row) { return row.spec.id == mission_layer; });
  return found == mission_layers.end() ? kShown : found->state;
}

void SceneState::setLocalization(const LocalizationStatus& status) {
  if (!isFinite(status.X_map_base)) return;
  snapshot_.X_ground_base =
      toIsometry(projectToGround(status.X_map_base)).inverse() * status.X_map_base;
  snapshot_.health = status.health;
  snapshot_.covariance_xy = status.covariance.topLeftCorner<2, 2>();
  if (submap_name_ != status.submap) {
    submap_name_ = status.submap;
    refreshSubmap();
  }
  touch(SceneLayer::Robot);
}

void SceneState::setMap(std::shared_ptr<const MapLayer> map) {
  if (map == snapshot_.map) return;
  snapshot_.map = std::move(map);
  refreshSubmap();
}

void SceneState::refreshSubmap() {
  snapshot_.submap = -1;
  if (snapshot_.map) {
    const auto& names = snapshot_.map->submaps;
    const auto found = std::find(names.begin(), names.end(), submap_name_);
    if (found != names.end()) snapshot_.submap = static_cast<int>(found - names.begin());
  }
  touch(SceneLayer::Map);
}

void SceneState::setTrajectory(const Trajectory& trajectory) {
  if (trajectory.legs.empty()) return;
  snapshot_.driven.clear();
  for (const TrajectoryLeg& leg : trajectory.legs) {
    auto& line = snapshot_.driven.emplace_back();
    for (const Pose2& X : leg.X_map_base) line.emplace_back(X.x_m, X.y_m);
  }
  resets_ = trajectory.legs.back().resets;
  trimTrail();
  touch(SceneLayer::Driven);
}

void SceneState::restart() {
  snapshot_.driven.clear();
  poses_.clear();
  touch(SceneLayer::Driven);
}

Freshness SceneState::freshnessAt(double age_s) const {
  return age_s < 0.0               ? Freshness::Missing
         : age_s < config_.aging_s ? Freshness::Fresh
         : age_s < config_.stale_s ? Freshness::Aging
                                   : Freshness::Stale;
}

void SceneState::setAge(SceneLayer l, double age_s) {
  LayerState& state = layer(l);
  state.age_s = age_s;
  const Freshness now = freshnessAt(age_s);
  if (now == state.freshness) return;
  state.freshness = now;
  touch(l);
}

void SceneState::setMissionAge(double age_s) {
  for (MissionLayer& row : snapshot_.mission_layers) {
    row.state.age_s = age_s;
    const Freshness now = freshnessAt(age_s);
    if (now == row.state.freshness) continue;
    row.state.freshness = now;
    ++snapshot_.items_revision;
  }
}

void SceneState::setVisible(SceneLayer l, bool visible) {
  if (layer(l).visible == visible) return;
  layer(l).visible = visible;
  touch(l);
}

void SceneState::setVisible(const std::string& mission_layer, bool visible) {
  for (MissionLayer& row : snapshot_.mission_layers) {
    if (row.spec.id != mission_layer || row.state.visible == visible) continue;
    row.state.visible = visible;
    ++snapshot_.items_revision;
  }
}

}  // namespace kiln::gui
