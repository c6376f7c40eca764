#include "robot/app/trajectory_log.h"

#include <cmath>

namespace kiln {
namespace {

constexpr double kStep_m = 0.05;
constexpr double kStep_rad = 0.1;
constexpr std::size_t kMostPoses = 4000;  ///< 200 m of way

bool moved(const Pose2& a, const Pose2& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) >= kStep_m ||
         std::abs(wrapAngle(a.yaw_rad - b.yaw_rad)) >= kStep_rad;
}

}  // namespace

bool TrajectoryLog::add(Stamp stamp, const Pose2& X_map_base, int resets) {
  auto& legs = trajectory_.legs;
  if (legs.empty() || legs.back().resets != resets) legs.push_back({resets, {}});
  auto& leg = legs.back().X_map_base;
  if (!leg.empty() && !moved(leg.back(), X_map_base)) return false;
  leg.push_back(X_map_base);
  trajectory_.stamp = stamp;
  if (++poses_ > kMostPoses) thin();
  return true;
}

void TrajectoryLog::thin() {
  poses_ = 0;
  for (TrajectoryLeg& leg : trajectory_.legs) {
    std::vector<Pose2> kept;
    for (std::size_t i = 0; i < leg.X_map_base.size(); i += 2) kept.push_back(leg.X_map_base[i]);
    poses_ += kept.size();
    leg.X_map_base = std::move(kept);
  }
}

}  // namespace kiln
