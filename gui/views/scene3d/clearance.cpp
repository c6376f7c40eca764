#include "gui/views/scene3d/clearance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kiln::gui {

namespace {
constexpr double kLowest_m = 0.15, kHighest_m = 1.8;  // above the ground under the robot
constexpr double kWithin_m = 0.10;  // the footprint: still something that touches it
constexpr double kUnseen_m = 0.10;  // nearer than this a scan may have lost it
constexpr double kSpot_m = 0.05;    // size of what is remembered as one
constexpr double kRemembered_s = 20.0;
constexpr std::size_t kNoise = 3, kMostSpots = 400;

/// Along the ground from a point in base to the footprint; nullopt deep within.
std::optional<double> beyond(double x, double y, const RobotGeometry& geometry) {
  const double dx = std::abs(x) - 0.5 * geometry.length_m;
  const double dy = std::abs(y) - 0.5 * geometry.width_m;
  if (std::max(dx, dy) < -kWithin_m) return std::nullopt;
  return std::hypot(std::max(0.0, dx), std::max(0.0, dy));
}

/// The nearest few, by distance.
class Nearest {
 public:
  Nearest() { nearest_.fill({INFINITY, 0.0}); }
  void add(double x, double y, double distance_m) {
    if (distance_m >= nearest_.back().distance_m) return;
    nearest_.back() = {distance_m, std::atan2(y, x)};
    for (std::size_t k = kNoise - 1; k > 0; --k)
      if (nearest_[k].distance_m < nearest_[k - 1].distance_m)
        std::swap(nearest_[k], nearest_[k - 1]);
  }
  [[nodiscard]] std::optional<Clearance> get() const {
    if (!std::isfinite(nearest_.back().distance_m)) return std::nullopt;
    return nearest_.back();
  }

 private:
  std::array<Clearance, kNoise> nearest_;
};
}  // namespace

std::optional<Clearance> ClearanceMeter::look(const SceneSnapshot& snapshot,
                                              const RobotGeometry& geometry) {
  if (!snapshot.robot_known || !snapshot.cloud) return std::nullopt;
  const PointCloud& cloud = *snapshot.cloud;
  const Eigen::Isometry3d X_map_base = snapshot.robotPose();
  const Eigen::Isometry3f X_base_cloud =
      (X_map_base.inverse() * snapshot.X_map_cloud).cast<float>();
  Nearest nearest;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = X_base_cloud * Eigen::Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]);
    if (!(p.z() > kLowest_m && p.z() < kHighest_m)) continue;
    const auto distance_m = beyond(p.x(), p.y(), geometry);
    if (!distance_m) continue;
    nearest.add(p.x(), p.y(), *distance_m);
    if (*distance_m < kUnseen_m) remember((X_map_base * p.cast<double>()).head<2>(), cloud.stamp);
  }
  std::erase_if(near_, [&](const Spot& spot) {
    const Eigen::Vector3d p =
        X_map_base.inverse() * Eigen::Vector3d(spot.at_map.x(), spot.at_map.y(), 0.0);
    const auto distance_m = beyond(p.x(), p.y(), geometry);
    const double age_s = toSeconds(cloud.stamp - spot.seen);
    if (!distance_m || *distance_m >= kUnseen_m || age_s < 0.0 || age_s > kRemembered_s)
      return true;
    if (spot.seen == cloud.stamp || spot.points < static_cast<int>(kNoise)) return false;
    for (std::size_t k = 0; k < kNoise; ++k) nearest.add(p.x(), p.y(), *distance_m);
    return false;
  });
  return nearest.get();
}

void ClearanceMeter::remember(const Eigen::Vector2d& at_map, Stamp now) {
  const auto known = std::find_if(near_.begin(), near_.end(), [&](const Spot& spot) {
    return (spot.at_map - at_map).squaredNorm() < kSpot_m * kSpot_m;
  });
  if (known == near_.end()) {
    if (near_.size() < kMostSpots) near_.push_back({at_map, 1, now});
    return;
  }
  known->points = known->seen == now ? known->points + 1 : 1;
  known->seen = now;
}

const char* sideWord(double bearing_rad) {
  static constexpr const char* kWords[] = {"ahead",  "ahead left",   "left",  "behind left",
                                           "behind", "behind right", "right", "ahead right"};
  const auto eighth = static_cast<int>(std::lround(bearing_rad / (M_PI / 4.0)));
  return kWords[static_cast<std::size_t>((eighth % 8 + 8) % 8)];
}

}  // namespace kiln::gui
