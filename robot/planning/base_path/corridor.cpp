#include "robot/planning/base_path/corridor.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kiln {
namespace {

constexpr double kStaysBeside = 0.03;  // m; noise of a point that stays beside the robot

/// Signed distance of a point to the footprint; negative inside.
double toFootprint(const Pose2& X_map_base, const Eigen::Vector2d& p_map, double length_m,
                   double width_m) {
  const Eigen::Vector2d d(p_map.x() - X_map_base.x_m, p_map.y() - X_map_base.y_m);
  const double c = std::cos(X_map_base.yaw_rad), s = std::sin(X_map_base.yaw_rad);
  const double x = std::abs(c * d.x() + s * d.y()) - 0.5 * length_m;
  const double y = std::abs(-s * d.x() + c * d.y()) - 0.5 * width_m;
  return std::hypot(std::max(x, 0.0), std::max(y, 0.0)) + std::min(std::max(x, y), 0.0);
}

struct Candidate {
  Eigen::Vector2d p_map;
  double gate_m;  ///< in the way when nearer to the footprint than this
};

/// Enough points in one place?
std::optional<CorridorHit> judged(const std::vector<Eigen::Vector2d>& found,
                                  const CorridorConfig& config) {
  for (const Eigen::Vector2d& seed : found) {
    CorridorHit hit;
    for (const Eigen::Vector2d& p : found) {
      if ((p - seed).norm() > config.gather_m) continue;
      hit.p_map += p;
      ++hit.points;
    }
    if (hit.points < config.min_points) continue;
    hit.p_map /= hit.points;
    return hit;
  }
  return std::nullopt;
}

}  // namespace

void CorridorConfig::visit(ConfigArchive& a) {
  a.field("look_ahead_m", look_ahead_m, "m", 0.2, 20, "along the path");
  a.field("margin_m", margin_m, "m", 0, 1, "beside the footprint");
  a.field("step_m", step_m, "m", 0.01, 0.5, "between two poses that are looked at");
  a.field("min_points", min_points, "", 1, 100, "fewer are noise");
  a.field("gather_m", gather_m, "m", 0.02, 2, "points count together within this");
}

std::optional<CorridorHit> firstInCorridor(const BasePath& path, double from_s,
                                           const Pose2& X_map_now, double length_m, double width_m,
                                           std::span<const Eigen::Vector2d> points_map,
                                           const CorridorConfig& config) {
  const double reach = config.look_ahead_m + 0.5 * std::hypot(length_m, width_m) + config.margin_m;
  std::vector<Candidate> candidates;
  for (const Eigen::Vector2d& p : points_map) {
    if (!p.allFinite() || std::hypot(p.x() - X_map_now.x_m, p.y() - X_map_now.y_m) > reach)
      continue;
    const double now = toFootprint(X_map_now, p, length_m, width_m);
    if (now >= 0.0) candidates.push_back({p, std::min(config.margin_m, now - kStaysBeside)});
  }
  const double to_s = std::min(path.length(), from_s + config.look_ahead_m);
  std::vector<Eigen::Vector2d> found;
  for (double s = from_s;; s = std::min(to_s, s + config.step_m)) {
    const Pose2 pose = path.poseAt(s);
    found.clear();
    for (const Candidate& c : candidates)
      if (toFootprint(pose, c.p_map, length_m, width_m) < c.gate_m) found.push_back(c.p_map);
    if (auto hit = judged(found, config)) {
      hit->distance_m = s - from_s;
      return hit;
    }
    if (s >= to_s) return std::nullopt;
  }
}

}  // namespace kiln
