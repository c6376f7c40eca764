#include "robot/skills/corridor_guard.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace kiln {
namespace {

constexpr double kHysteresis = 0.15;  // m more before it drives on towards something
constexpr double kCreep = 0.08;       // m/s; slower is waiting

}  // namespace

void CorridorGuard::Config::visit(ConfigArchive& a) {
  a.field("enabled", enabled, "look at the live cloud while driving");
  a.section("corridor", corridor, "swept footprint against points");
  a.field("stop_gap_m", stop_gap_m, "m", 0.05, 3, "waits this far before something");
  a.field("decel_mps2", decel_mps2, "m/s^2", 0.05, 3, "slows down by this towards it");
  a.field("clear_s", clear_s, "s", 0, 10, "free for so long before it drives on");
  a.field("blind_s", blind_s, "s", 0.2, 10, "no scan for so long: waits");
  a.field("give_up_s", give_up_s, "s", 1, 600, "blocked for so long: the drive has failed");
}

void CorridorGuard::restart() { *this = CorridorGuard(config_); }

std::optional<CorridorHit> CorridorGuard::search(const Surroundings& surroundings,
                                                 const ObstacleCloud& cloud, const BasePath& path,
                                                 double from_s, const Pose2& X_map_base,
                                                 double length_m, double width_m) const {
  const Pose2 X_map_odom = X_map_base * inverse(surroundings.X_odom_base());
  const Eigen::Isometry2d X =
      Eigen::Translation2d(X_map_odom.x_m, X_map_odom.y_m) * Eigen::Rotation2Dd(X_map_odom.yaw_rad);
  std::vector<Eigen::Vector2d> points;
  points.reserve(cloud.points.size());
  for (const ObstacleCloud::Point& p : cloud.points)
    points.emplace_back(X * p.p_odom.head<2>().cast<double>());
  return firstInCorridor(path, from_s, X_map_base, length_m, width_m, points, config_.corridor);
}

CorridorGuard::View CorridorGuard::look(const Surroundings& surroundings, const BasePath& path,
                                        double from_s, const Pose2& X_map_base, double length_m,
                                        double width_m, Stamp now) {
  View view;
  if (!config_.enabled) return view;
  const ObstacleCloudPtr cloud = surroundings.obstacles();
  const double age_s = cloud ? toSeconds(now - cloud->stamp) : 1e9;
  if (age_s > config_.blind_s) {
    view.max_speed_mps = 0.0;
    view.reason = cloud ? fmt::format("no LiDAR scan for {:.1f} s", age_s) : "no LiDAR scan yet";
  } else if (judged_ != cloud->stamp) {
    judged_ = cloud->stamp;
    judged_s_ = from_s;
    hit_ = search(surroundings, *cloud, path, from_s, X_map_base, length_m, width_m);
    if (hit_) last_hit_ = now;
  }
  if (view.reason.empty() && hit_) {
    const double ahead = std::max(0.0, judged_s_ + hit_->distance_m - from_s);
    const double room = ahead - config_.stop_gap_m - (waiting_since_ ? kHysteresis : 0.0);
    const double speed = room > 0.0 ? std::sqrt(2.0 * config_.decel_mps2 * room) : 0.0;
    view.max_speed_mps = speed < kCreep ? 0.0 : speed;
    view.reason = fmt::format("path blocked by something {:.1f} m ahead", ahead);
  }
  const bool just_cleared = last_hit_ && now - *last_hit_ < fromSeconds(config_.clear_s);
  if (view.reason.empty() && waiting_since_ && just_cleared) {
    view.max_speed_mps = 0.0;
    view.reason = "path is free again; waiting a moment";
  }
  if (view.max_speed_mps > 0.0) {
    waiting_since_.reset();
  } else if (!waiting_since_) {
    waiting_since_ = now;
  }
  view.given_up = waiting_since_ && now - *waiting_since_ > fromSeconds(config_.give_up_s);
  return view;
}

}  // namespace kiln
