#include "gui/views/scene3d/clearance.h"

#include <array>
#include <cmath>

namespace kiln::gui {

namespace {
constexpr double kLowest_m = 0.15, kHighest_m = 1.8;  // above the ground under the robot
constexpr double kOwn_m = 0.05;  // what is so near to the footprint's edge may be the robot's own
constexpr std::size_t kNoise = 3;

/// Along the ground from a point in base to the footprint; 0 within.
double beyond(double x, double y, const RobotGeometry& geometry) {
  return std::hypot(std::max(0.0, std::abs(x) - 0.5 * geometry.length_m),
                    std::max(0.0, std::abs(y) - 0.5 * geometry.width_m));
}
}  // namespace

std::optional<Clearance> nearestObstacle(const SceneSnapshot& snapshot,
                                         const RobotGeometry& geometry) {
  if (!snapshot.robot_known || !snapshot.cloud) return std::nullopt;
  const PointCloud& cloud = *snapshot.cloud;
  const Eigen::Isometry3f X_base_cloud =
      (snapshot.robotPose().inverse() * snapshot.X_map_cloud).cast<float>();
  std::array<Clearance, kNoise> nearest;  // by distance
  nearest.fill({INFINITY, 0.0});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = X_base_cloud * Eigen::Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]);
    if (!(p.z() > kLowest_m && p.z() < kHighest_m)) continue;
    const double distance_m = beyond(p.x(), p.y(), geometry);
    if (distance_m <= kOwn_m || distance_m >= nearest.back().distance_m) continue;
    nearest.back() = {distance_m, std::atan2(p.y(), p.x())};
    for (std::size_t k = kNoise - 1; k > 0; --k)
      if (nearest[k].distance_m < nearest[k - 1].distance_m) std::swap(nearest[k], nearest[k - 1]);
  }
  if (!std::isfinite(nearest.back().distance_m)) return std::nullopt;
  return nearest.back();
}

const char* sideWord(double bearing_rad) {
  static constexpr const char* kWords[] = {"ahead",  "ahead left",   "left",  "behind left",
                                           "behind", "behind right", "right", "ahead right"};
  const auto eighth = static_cast<int>(std::lround(bearing_rad / (M_PI / 4.0)));
  return kWords[static_cast<std::size_t>((eighth % 8 + 8) % 8)];
}

}  // namespace kiln::gui
