#include "robot/missions/common/route.h"

#include <algorithm>
#include <cmath>

#include "robot/scene/obstacles.h"

namespace kiln {
namespace {
constexpr double kSample_m = 0.05;
constexpr double kRunUp_m = 0.6;       // of a wheel's centre before the edge
constexpr double kBeforeEdge_m = 0.3;  // nearer than this it has no speed when it gets there
constexpr double kOnEdge_m = 0.05;     // beyond this it is over it

/// Distance on the ground from a point to a box's footprint; 0 inside.
double groundDistance(const BoxConfig& box, double x_m, double y_m) {
  const Eigen::Vector3d p =
      box.center.pose().inverse() * Eigen::Vector3d(x_m, y_m, box.center.xyz_m[2]);
  const double dx = std::max(0.0, std::abs(p.x()) - 0.5 * box.size_m[0]);
  const double dy = std::max(0.0, std::abs(p.y()) - 0.5 * box.size_m[1]);
  return std::hypot(dx, dy);
}

/// Lintels and the like are driven under.
constexpr double kHeadroom_m = 2.0;
bool standsInTheWay(const BoxConfig& box) {
  return box.center.xyz_m[2] - 0.5 * box.size_m[2] < kHeadroom_m;
}

double segmentDistance(const Pose2& a, const Pose2& b, const Pose2& p) {
  const Eigen::Vector2d ab(b.x_m - a.x_m, b.y_m - a.y_m);
  const Eigen::Vector2d ap(p.x_m - a.x_m, p.y_m - a.y_m);
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp(ap.dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (ap - s * ab).norm();
}

}  // namespace

bool straightIsClear(const ArenaMap& arena, const Pose2& a, const Pose2& b, double radius_m) {
  std::vector<BoxConfig> boxes = obstacles(arena);
  std::erase_if(boxes, [](const BoxConfig& box) { return !standsInTheWay(box); });
  const int steps = 1 + static_cast<int>(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / kSample_m);
  for (int i = 0; i <= steps; ++i) {
    const double s = static_cast<double>(i) / steps;
    const double x = (1.0 - s) * a.x_m + s * b.x_m;
    const double y = (1.0 - s) * a.y_m + s * b.y_m;
    for (const BoxConfig& box : boxes)
      if (groundDistance(box, x, y) < radius_m) return false;
  }
  return true;
}

std::vector<Pose2> shortened(const ArenaMap& arena, const Pose2& from,
                             const std::vector<Pose2>& route, double radius_m) {
  std::vector<Pose2> out;
  Pose2 here = from;
  for (std::size_t i = 0; i < route.size();) {
    std::size_t furthest = i;
    for (std::size_t j = i + 1; j < route.size(); ++j)
      if (straightIsClear(arena, here, route[j], radius_m)) furthest = j;
    out.push_back(route[furthest]);
    here = route[furthest];
    i = furthest + 1;
  }
  return out;
}

std::vector<Pose2> remaining(const Pose2& start, const std::vector<Pose2>& route,
                             const Pose2& here) {
  std::size_t nearest = 0;
  double best = segmentDistance(start, route.empty() ? start : route.front(), here);
  for (std::size_t i = 1; i < route.size(); ++i) {
    const double distance = segmentDistance(route[i - 1], route[i], here);
    if (distance < best - 1e-6) {
      best = distance;
      nearest = i;
    }
  }
  return {route.begin() + static_cast<std::ptrdiff_t>(std::min(nearest, route.size())),
          route.end()};
}

std::optional<Pose2> runUp(const ApproachConfig& approach, const RobotGeometry& robot,
                           const Pose2& here, const Pose2& to) {
  if (approach.edge_m <= 0.0) return std::nullopt;
  double back_m = 0.0;
  for (const double x_m : {robot.wheel_x_m, -robot.wheel_x_m}) {
    for (const double y_m : {robot.wheel_y_m, -robot.wheel_y_m}) {
      const Pose2 X_base_wheel{x_m, y_m, 0.0};
      const double before_m = approach.edge_x_m - (here * X_base_wheel).x_m;
      const bool crosses = (to * X_base_wheel).x_m > approach.edge_x_m + kOnEdge_m;
      if (crosses && before_m < kBeforeEdge_m && before_m > -kOnEdge_m)
        back_m = std::max(back_m, kRunUp_m - before_m);
    }
  }
  if (back_m <= 0.0) return std::nullopt;
  return Pose2{here.x_m - back_m, here.y_m, here.yaw_rad};
}

}  // namespace kiln
