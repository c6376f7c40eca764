#include <cmath>

#include "common/core/log.h"
#include "robot/localization/mapping/map_anchor.h"
#include "robot/localization/mapping/map_builder.h"

namespace kiln {
namespace {

constexpr double kCenterHeight_m = 0.8;  // of the grids: from 1.6 m below to 3.2 m above the floor

/// The middle of the walls: where the fine level of the indoor map belongs.
Eigen::Vector3d middleOfWalls(const ArenaMap& arena) {
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const BoxConfig& wall : arena.walls) {
    const Eigen::Vector2d p(wall.center.xyz_m[0], wall.center.xyz_m[1]);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), kCenterHeight_m};
}

}  // namespace

Result<void> MapBuilder::anchor(MapReport& report) {
  const auto found = anchorMap(*working_, keyframes_, poses_, arena_);
  if (!found) return tl::make_unexpected(found.error());
  for (Eigen::Isometry3d& X : poses_) X = found->X_arena_map * X;
  report.floor_rms_m = found->floor_rms_m;
  report.wall_rms_m = found->wall_rms_m;
  report.wall_rms_deg = found->wall_rms_deg;
  report.wall_fixes = found->wall_fixes;
  return {};
}

LocalizationMap MapBuilder::segments(MapReport& report) const {
  const Pose2 X_door_map = inverse(arena_.doorway.pose());
  std::vector<int> outside, within;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const double beyond_door_m = (X_door_map * projectToGround(poses_[i])).x_m;
    if (beyond_door_m < config_.overlap_m) outside.push_back(static_cast<int>(i));
    if (beyond_door_m > -config_.overlap_m) within.push_back(static_cast<int>(i));
  }
  const Pose2 start = arena_.start.pose(), door = arena_.doorway.pose();
  const Eigen::Vector3d before_door(0.4 * start.x_m + 0.6 * door.x_m,
                                    0.4 * start.y_m + 0.6 * door.y_m, kCenterHeight_m);
  LocalizationMap out;
  out.arena = arena_.name;
  const auto add = [&](const char* name, const std::vector<int>& nodes,
                       const Eigen::Vector3d& p_map_center) {
    const auto map = mapOf(nodes, config_.shipped, p_map_center);
    MapReport::Segment segment;
    segment.name = name;
    segment.keyframes = static_cast<int>(nodes.size());
    for (int level = 0; level < config_.shipped.levels; ++level)
      segment.surfels.push_back(static_cast<int>(map->surfels(level).size()));
    if (&nodes == &within) segment.wall_coverage = wallCoverage(*map, arena_);
    report.segments.push_back(segment);
    out.segments.push_back({name, map});
  };
  add("outdoor", outside, before_door);
  add("indoor", within, middleOfWalls(arena_));
  return out;
}

}  // namespace kiln
