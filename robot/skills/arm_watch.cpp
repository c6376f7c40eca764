#include "robot/skills/arm_watch.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace kiln {
namespace {

/// Does the point show one of these boxes?
bool shows(std::span<const OrientedBox> boxes, const Eigen::Vector3f& p_base) {
  constexpr double kSurface_m = 0.05;  // of what the LiDAR makes of a surface
  const Eigen::Vector3d p = p_base.cast<double>();
  return std::any_of(boxes.begin(), boxes.end(), [&](const OrientedBox& box) {
    return box.bounds.squaredExteriorDistance(p) < kSurface_m * kSurface_m &&
           signedDistance(box.X_frame_box.inverse() * p, box.half) < kSurface_m;
  });
}

}  // namespace

void ArmWatchConfig::visit(ConfigArchive& a) {
  a.field("enabled", enabled, "look at the live cloud before the arm moves");
  a.field("blind_s", blind_s, "s", 0.2, 60, "an older cloud says nothing: refused");
  a.field("reach_m", reach_m, "m", 0.5, 10, "points farther from the arm are not looked at");
  a.section("swept", swept, "arm and head against points");
}

std::string whatHindersArm(const ArmWatchConfig& config, const ArmCollision& arm,
                           const Eigen::Vector3d& p_base_armbase, std::span<const JointPath> paths,
                           std::span<const OrientedBox> known, const Surroundings& surroundings,
                           Stamp now) {
  if (!config.enabled) return {};
  const ObstacleCloudPtr cloud = surroundings.obstacles();
  if (!cloud) return "the arm does not move blindly: there is no LiDAR scan yet";
  if (now - cloud->stamp > fromSeconds(config.blind_s))
    return fmt::format("the arm does not move blindly: the newest LiDAR scan is {:.1f} s old",
                       toSeconds(now - cloud->stamp));
  const Eigen::Isometry3f X_base_odom =
      toIsometry(inverse(surroundings.X_odom_base())).cast<float>();
  std::vector<Eigen::Vector3f> points;
  for (const ObstacleCloud::Point& point : cloud->points) {
    const Eigen::Vector3f p = X_base_odom * point.p_odom;
    if ((p - p_base_armbase.cast<float>()).norm() < config.reach_m && !shows(known, p))
      points.push_back(p);
  }
  const auto hit = firstInSweptVolume(arm, paths, PointGrid(std::move(points)), config.swept);
  if (!hit) return {};
  return fmt::format(
      "something stands where the {} would pass, {:.2f} m ahead, {:.2f} m to the {}, {:.2f} m high "
      "({} points)",
      hit->part, hit->p_base.x(), std::abs(hit->p_base.y()),
      hit->p_base.y() >= 0 ? "left" : "right", hit->p_base.z(), hit->points);
}

}  // namespace kiln
