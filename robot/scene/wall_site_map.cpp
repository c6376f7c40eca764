#include "robot/scene/wall_site_map.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/config/required_keys.h"
#include "common/core/check.h"
#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kStandOff_m = 2.5;  ///< of a robot that works there, from the middle of the line

GroundPoseConfig stand(const Pose2& X_map_frame, double x_m, double y_m) {
  const Pose2 X = X_map_frame * Pose2{x_m, y_m, std::copysign(M_PI / 2.0, -y_m)};
  return {{X.x_m, X.y_m}, X.yaw_rad / kDeg};
}

std::vector<std::string> brickNames() {
  std::vector<std::string> names;
  for (const BrickShape& shape : kBrickShapes) names.emplace_back(shape.name);
  return names;
}

bool inside(const std::vector<GroundPointConfig>& corners, double x, double y) {
  bool in = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const std::vector<double>&a = corners[i].xy_m, &b = corners[j].xy_m;
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])) in = !in;
  }
  return in;
}

}  // namespace

void BrickStackConfig::visit(ConfigArchive& a) {
  a.choice("kind", kind, brickNames(), "what lies there");
  a.field("line", line, "", 1, 2, "1: the first line, 2: the one behind it");
  a.field("bricks", bricks, "", 1, 10, "on top of each other");
}

PileStack BrickStackConfig::stack() const {
  const auto found = std::find_if(kBrickShapes.begin(), kBrickShapes.end(),
                                  [&](const BrickShape& shape) { return shape.name == kind; });
  KILN_CHECK(found != kBrickShapes.end(), kind);
  return {found->kind, line, bricks};
}

void WallSiteMap::visit(ConfigArchive& a) {
  a.section("pile", pile, "beginning of line 1, X along it, Y to line 2");
  a.section("marker", marker, "outer corner of the L, X along the leg of the blueprint");
  a.field("known_m", known_m, "m", 0, 10, "pile and marker are known to, +-");
  a.field("known_deg", known_deg, "deg", 0, 90, "pile and marker are known to, +-");
  a.list("stacks", stacks, "of the pile; each line's follow each other along X");
  a.field("stack_gap_m", stack_gap_m, "m", 0, 2, "between the stacks of a line");
  a.field("line_distance_m", line_distance_m, "m", 0.3, 20, "between the middles of the lines");
  a.list("search_area", search_area, "corners in order; nothing outside is pile or marker");
}

Result<void> WallSiteMap::validate() const {
  for (const auto& [what, pose] : {std::pair{"pile", &pile}, std::pair{"marker", &marker}}) {
    if (!inside(search_area, pose->xy_m[0], pose->xy_m[1]))
      return makeError(ErrorCode::InvalidInput,
                       "{} at ({}, {}) lies outside search_area; move one of the two", what,
                       pose->xy_m[0], pose->xy_m[1]);
  }
  return {};
}

PileLayout WallSiteMap::layout() const {
  PileLayout out{{}, stack_gap_m, line_distance_m};
  for (const BrickStackConfig& config : stacks) out.stacks.push_back(config.stack());
  return out;
}

SiteFixtures WallSiteMap::fixtures() const {
  SiteFixtures out;
  const Pose2 X_map_pile = pile.pose();
  const PileLayout planned = layout();
  const std::vector<Eigen::Vector2d> middles = planned.middles();
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const double height = planned.stacks[i].bricks * kBrickSide_m;
    const Pose2 X = X_map_pile * Pose2{middles[i].x(), middles[i].y(), 0.0};
    out.boxes.push_back({fmt::format("pile, {} stack {}", stacks[i].kind, i + 1),
                         {{X.x_m, X.y_m, height / 2.0}, {0, 0, X.yaw_rad / kDeg}},
                         {planned.stacks[i].length(), kBrickSide_m, height}});
  }
  out.stands.push_back(stand(X_map_pile, planned.length() / 2.0, -kStandOff_m));
  out.stands.push_back(stand(marker.pose(), 2.0, -kStandOff_m));
  return out;
}

Result<WallSiteMap> loadWallSite(const ArenaMap& arena) {
  for (const SiteConfig& site : arena.sites) {
    if (site.mission != kWallSite) continue;
    auto loaded = loadComplete<WallSiteMap>(site.file, {"pile", "marker", "stacks", "search_area"});
    if (!loaded) return loaded;
    if (auto ok = loaded->validate(); !ok)
      return makeError(ErrorCode::InvalidInput, "{}: {}", site.file, ok.error().message);
    return loaded;
  }
  return WallSiteMap{};
}

}  // namespace kiln
