#include "robot/localization/wall_segments.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kiln {
namespace {
constexpr double kHeightMargin_m = 0.05;  // LiDAR height errs by extrinsics and floor
constexpr double kUpright = 0.99985;      // cos(1 deg)
}  // namespace

std::vector<WallSegment> wallSegments(const std::vector<BoxConfig>& boxes) {
  std::vector<WallSegment> out;
  for (const BoxConfig& box : boxes) {
    const Eigen::Isometry3d X_map_box = box.center.pose();
    if (X_map_box.linear()(2, 2) < kUpright) continue;
    const double hx = 0.5 * box.size_m[0], hy = 0.5 * box.size_m[1], hz = 0.5 * box.size_m[2];
    // Counter-clockwise, so that the outward normal is to the right of the direction of travel.
    const std::array<Eigen::Vector3d, 4> corners{
        {{-hx, -hy, 0}, {hx, -hy, 0}, {hx, hy, 0}, {-hx, hy, 0}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d a = (X_map_box * corners[i]).head<2>();
      const Eigen::Vector2d b = (X_map_box * corners[(i + 1) % 4]).head<2>();
      WallSegment segment;
      segment.start = a;
      segment.length_m = (b - a).norm();
      segment.direction = (b - a) / segment.length_m;
      segment.normal = {segment.direction.y(), -segment.direction.x()};
      segment.z_min_m = X_map_box.translation().z() - hz;
      segment.z_max_m = X_map_box.translation().z() + hz;
      out.push_back(segment);
    }
  }
  return out;
}

std::vector<WallSegment> facing(const std::vector<WallSegment>& segments,
                                const Eigen::Vector2d& p_map_sensor) {
  std::vector<WallSegment> out;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(out),
               [&](const WallSegment& segment) {
                 return segment.normal.dot(p_map_sensor - segment.start) > 0.0;
               });
  return out;
}

bool nearestWall(const std::vector<WallSegment>& segments, const Eigen::Vector3d& p_map,
                 double gate_m, WallMatch& match) {
  const Eigen::Vector2d p = p_map.head<2>();
  double best = gate_m * gate_m;
  const WallSegment* nearest = nullptr;
  double nearest_along = 0.0, nearest_off = 0.0;
  for (const WallSegment& segment : segments) {
    if (p_map.z() < segment.z_min_m - kHeightMargin_m ||
        p_map.z() > segment.z_max_m + kHeightMargin_m)
      continue;
    const Eigen::Vector2d d = p - segment.start;
    const double off = segment.normal.dot(d);
    if (off * off >= best) continue;
    const double along = segment.direction.dot(d);
    const double beyond = along - std::clamp(along, 0.0, segment.length_m);
    const double squared = off * off + beyond * beyond;
    if (squared >= best) continue;
    best = squared;
    nearest = &segment;
    nearest_along = beyond;
    nearest_off = off;
  }
  if (nearest == nullptr) return false;
  match.on_edge = nearest_along != 0.0;
  if (!match.on_edge) {
    match.distance_m = nearest_off;
    match.direction = nearest->normal;
  } else {
    match.distance_m = std::sqrt(best);
    match.direction =
        (nearest_off * nearest->normal + nearest_along * nearest->direction) / match.distance_m;
  }
  return true;
}

}  // namespace kiln
