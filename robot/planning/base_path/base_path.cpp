#include "robot/planning/base_path/base_path.h"

#include <algorithm>
#include <cmath>

#include "robot/planning/arm_motion/shapes.h"
#include "robot/planning/corner_window.h"

namespace kiln {
namespace {

constexpr double kFootprintBottom = 0.05,
                 kFootprintTop = 1.6;   // m; lintels above and the ground do not count
constexpr double kCheckSpacing = 0.05;  // m
constexpr double kNoWay = 1e-3;         // m; shorter lines are no lines

}  // namespace

void BasePathConfig::visit(ConfigArchive& a) {
  a.field("speed_mps", speed_mps, "m/s", 0.05, 4, "on straight lines");
  a.field("approach_speed_mps", approach_speed_mps, "m/s", 0.02, 4, "near the end");
  a.field("approach_distance_m", approach_distance_m, "m", 0, 5, "where the end begins");
  a.field("yaw_rate_radps", yaw_rate_radps, "rad/s", 0.05, 3, "turning speed");
  a.field("accel_mps2", accel_mps2, "m/s^2", 0.05, 3, "along the path and across it");
  a.field("jerk_time_s", jerk_time_s, "s", 0.02, 2, "ramp of the acceleration");
  a.field("corner_radius_m", corner_radius_m, "m", 0, 3, "way-points are passed within this");
  a.field("turn_weight_m", turn_weight_m, "m/rad", 0.1, 3, "way that 1 rad counts as");
  a.field("step_m", step_m, "m", 0.005, 0.2, "spacing of the samples");
}

BasePath::BasePath(const Pose2& X_map_start, const std::vector<Pose2>& waypoints_map,
                   const BasePathConfig& config)
    : s_{0.0}, poses_{X_map_start} {
  for (const Pose2& waypoint : waypoints_map) {
    appendLine(waypoint, config);
    waypoint_sample_.push_back(poses_.size() - 1);
  }
  roundCorners(config);
  timing_ = PathTiming(limits(config), config.jerk_time_s);
}

double BasePath::wayBetween(const Pose2& from, const Pose2& to, const BasePathConfig& config) {
  return std::max(std::hypot(to.x_m - from.x_m, to.y_m - from.y_m),
                  std::abs(to.yaw_rad - from.yaw_rad) * config.turn_weight_m);
}

void BasePath::appendLine(const Pose2& to, const BasePathConfig& config) {
  const Pose2 from = poses_.back();
  const double turn = wrapAngle(to.yaw_rad - from.yaw_rad);
  const double length = wayBetween(from, {to.x_m, to.y_m, from.yaw_rad + turn}, config);
  if (length < kNoWay && poses_.size() > 1) return;
  const int steps = std::max(2, static_cast<int>(std::ceil(length / config.step_m)));
  const double start = s_.back();
  for (int k = 1; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps;
    s_.push_back(start + part * length);
    poses_.push_back({from.x_m + part * (to.x_m - from.x_m), from.y_m + part * (to.y_m - from.y_m),
                      from.yaw_rad + part * turn});
  }
}

/// A sliding mean over the way turns corners into parabolas.
void BasePath::roundCorners(const BasePathConfig& config) {
  const std::vector<Pose2> raw = poses_;
  const auto wanted = static_cast<std::size_t>(config.corner_radius_m / config.step_m);
  const auto window = cornerWindows(raw.size(), waypoint_sample_, wanted);
  for (std::size_t k = 1; k + 1 < raw.size(); ++k) {
    Pose2 mean;
    for (std::size_t i = k - window[k]; i <= k + window[k]; ++i) {
      mean.x_m += raw[i].x_m;
      mean.y_m += raw[i].y_m;
      mean.yaw_rad += raw[i].yaw_rad;
    }
    const double n = static_cast<double>(2 * window[k] + 1);
    poses_[k] = {mean.x_m / n, mean.y_m / n, mean.yaw_rad / n};
  }
  for (std::size_t k = 1; k < poses_.size(); ++k) {
    s_[k] = s_[k - 1] + wayBetween(poses_[k - 1], poses_[k], config);
  }
}

Twist2 BasePath::slope(std::size_t k) const {
  const std::size_t a = k == 0 ? 0 : k - 1;
  const std::size_t b = std::min(k + 1, poses_.size() - 1);
  const double ds = s_[b] - s_[a];
  if (ds <= 0.0) return {};
  return {(poses_[b].x_m - poses_[a].x_m) / ds, (poses_[b].y_m - poses_[a].y_m) / ds,
          (poses_[b].yaw_rad - poses_[a].yaw_rad) / ds};
}

std::vector<PathTiming::Sample> BasePath::limits(const BasePathConfig& config) const {
  std::vector<PathTiming::Sample> out(s_.size());
  for (std::size_t k = 0; k < s_.size(); ++k) {
    const std::size_t a = k == 0 ? 0 : k - 1;
    const std::size_t b = std::min(k + 1, s_.size() - 1);
    const double ds = std::max(s_[b] - s_[a], 1e-9);
    const Twist2 here = slope(k), before = slope(a), after = slope(b);
    const double bend = std::hypot(after.vx_mps - before.vx_mps, after.vy_mps - before.vy_mps) / ds;
    const bool near_end = s_.back() - s_[k] < config.approach_distance_m;
    double speed = near_end ? config.approach_speed_mps : config.speed_mps;
    if (std::abs(here.wz_radps) > 1e-9) {
      speed = std::min(speed, config.yaw_rate_radps / std::abs(here.wz_radps));
    }
    if (bend > 1e-9) speed = std::min(speed, std::sqrt(config.accel_mps2 / bend));
    out[k] = {s_[k], std::max(speed, 0.02), config.accel_mps2};
  }
  return out;
}

BasePath::Point BasePath::at(double t_s) const {
  const PathPoint along = timing_.at(t_s);
  const auto after = std::upper_bound(s_.begin(), s_.end(), along.s);
  const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
      after - s_.begin(), 1, static_cast<std::ptrdiff_t>(s_.size()) - 1));
  const double h = s_[k] - s_[k - 1];
  const double u = h > 0.0 ? std::clamp((along.s - s_[k - 1]) / h, 0.0, 1.0) : 1.0;
  const Pose2 &a = poses_[k - 1], &b = poses_[k];
  const Twist2 ta = slope(k - 1), tb = slope(k);
  const auto mix = [u](double from, double to) { return from + u * (to - from); };
  Point point;
  point.s = along.s;
  point.X_map_base = {mix(a.x_m, b.x_m), mix(a.y_m, b.y_m), wrapAngle(mix(a.yaw_rad, b.yaw_rad))};
  point.v_map = {mix(ta.vx_mps, tb.vx_mps) * along.speed, mix(ta.vy_mps, tb.vy_mps) * along.speed,
                 mix(ta.wz_radps, tb.wz_radps) * along.speed};
  return point;
}

Pose2 BasePath::poseAt(double s) const {
  const auto after = std::upper_bound(s_.begin(), s_.end(), s);
  if (after == s_.begin()) return poses_.front();
  if (after == s_.end()) return poses_.back();
  const auto k = static_cast<std::size_t>(after - s_.begin());
  const double u = (s - s_[k - 1]) / (s_[k] - s_[k - 1]);
  const Pose2 &a = poses_[k - 1], &b = poses_[k];
  return {a.x_m + u * (b.x_m - a.x_m), a.y_m + u * (b.y_m - a.y_m),
          wrapAngle(a.yaw_rad + u * (b.yaw_rad - a.yaw_rad))};
}

int BasePath::nextWaypoint(double s) const {
  int next = 0;
  while (next + 1 < static_cast<int>(waypoint_sample_.size()) &&
         s_[waypoint_sample_[static_cast<std::size_t>(next)]] <= s) {
    ++next;
  }
  return next;
}

std::optional<std::string> firstObstacle(const BasePath& path, double length_m, double width_m,
                                         const std::vector<BoxConfig>& boxes_map) {
  std::vector<OrientedBox> boxes;
  for (const BoxConfig& box : boxes_map) {
    boxes.push_back(
        makeBox(box.center.pose(), {box.size_m[0], box.size_m[1], box.size_m[2]}, box.name));
  }
  const auto touched = [&](const Pose2& X_map_base, const OrientedBox& box) {
    const Eigen::Isometry3d X_base_center(
        Eigen::Translation3d(0.0, 0.0, 0.5 * (kFootprintBottom + kFootprintTop)));
    const OrientedBox footprint =
        makeBox(toIsometry(X_map_base) * X_base_center,
                {length_m, width_m, kFootprintTop - kFootprintBottom}, "");
    return distance(footprint, box) < 0.0;
  };
  std::erase_if(boxes,
                [&](const OrientedBox& box) { return touched(path.samples().front(), box); });
  Pose2 checked = path.samples().front();
  for (const Pose2& pose : path.samples()) {
    const bool moved = std::hypot(pose.x_m - checked.x_m, pose.y_m - checked.y_m) > kCheckSpacing ||
                       std::abs(pose.yaw_rad - checked.yaw_rad) > kCheckSpacing;
    if (!moved && &pose != &path.samples().back()) continue;
    checked = pose;
    for (const OrientedBox& box : boxes) {
      if (touched(pose, box)) return box.name;
    }
  }
  return std::nullopt;
}

}  // namespace kiln
