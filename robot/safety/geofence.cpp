#include "robot/safety/geofence.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace kiln {
namespace {

constexpr double kOutlineStep = 0.2;  // m; a corner of a concave fence can poke in so far unseen
constexpr int kBisections = 12;
constexpr double kLookAhead = 0.1;  // s; of a command that shall lead back in

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double toSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double s = std::clamp((p - a).dot(ab) / std::max(1e-12, ab.squaredNorm()), 0.0, 1.0);
  return (p - a - s * ab).norm();
}

bool crosses(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
             const Eigen::Vector2d& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 &&
         cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

/// Where a constant command leads in `t` seconds: a circle's arc.
Pose2 after(const Pose2& X_map_base, const Twist2& v, double t) {
  const double turn = v.wz_radps * t;
  const double a = std::abs(turn) > 1e-6 ? std::sin(turn) / turn : 1.0;
  const double b = std::abs(turn) > 1e-6 ? (1.0 - std::cos(turn)) / turn : 0.5 * turn;
  return X_map_base *
         Pose2{t * (a * v.vx_mps - b * v.vy_mps), t * (b * v.vx_mps + a * v.vy_mps), turn};
}

Twist2 scaled(const Twist2& v, double k) { return {k * v.vx_mps, k * v.vy_mps, k * v.wz_radps}; }

}  // namespace

void Geofence::Config::visit(ConfigArchive& a) {
  a.field("margin_m", margin_m, "m", 0, 2, "around the footprint");
  a.field("decel_mps2", decel_mps2, "m/s^2", 0.1, 3, "planned braking before the border");
  a.field("reaction_s", reaction_s, "s", 0, 2, "until the base follows");
}

Result<Geofence> Geofence::create(const Config& config, std::vector<Eigen::Vector2d> corners_map,
                                  double footprint_length_m, double footprint_width_m) {
  const std::size_t n = corners_map.size();
  if (n < 3)
    return makeError(ErrorCode::InvalidInput, "the geofence has {} corners; it needs at least 3",
                     n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!corners_map[i].allFinite())
      return makeError(ErrorCode::InvalidInput, "corner {} of the geofence is not a number", i + 1);
    for (std::size_t k = i + 1; k < n; ++k) {
      if (crosses(corners_map[i], corners_map[(i + 1) % n], corners_map[k],
                  corners_map[(k + 1) % n]))
        return makeError(ErrorCode::InvalidInput,
                         "the geofence crosses itself between its corners {} and {}", i + 1, k + 1);
    }
  }
  Geofence fence;
  fence.config_ = config;
  fence.corners_ = std::move(corners_map);
  const double hx = 0.5 * footprint_length_m + config.margin_m,
               hy = 0.5 * footprint_width_m + config.margin_m;
  const auto side = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kOutlineStep)));
    for (int i = 0; i < steps; ++i)
      fence.outline_base_.emplace_back(from + (to - from) * (static_cast<double>(i) / steps));
  };
  side({hx, hy}, {-hx, hy});
  side({-hx, hy}, {-hx, -hy});
  side({-hx, -hy}, {hx, -hy});
  side({hx, -hy}, {hx, hy});
  return fence;
}

double Geofence::toBorder(const Eigen::Vector2d& p) const {
  double nearest = INFINITY;
  bool in = false;
  for (std::size_t i = 0, k = corners_.size() - 1; i < corners_.size(); k = i++) {
    const Eigen::Vector2d &a = corners_[i], &b = corners_[k];
    nearest = std::min(nearest, toSegment(p, a, b));
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      in = !in;
  }
  return in ? nearest : -nearest;
}

double Geofence::room(const Pose2& X_map_base) const {
  const double c = std::cos(X_map_base.yaw_rad), s = std::sin(X_map_base.yaw_rad);
  double least = INFINITY;
  for (const Eigen::Vector2d& p : outline_base_) {
    least = std::min(least, toBorder({X_map_base.x_m + c * p.x() - s * p.y(),
                                      X_map_base.y_m + s * p.x() + c * p.y()}));
  }
  return least;
}

Geofence::Limited Geofence::limit(const Twist2& wish, const Pose2& X_map_base) const {
  if (!std::isfinite(X_map_base.x_m + X_map_base.y_m + X_map_base.yaw_rad))
    return {{}, true, "geofence: the pose of the base is not known"};
  const double here = room(X_map_base);
  if (here < 0.0) {
    if (room(after(X_map_base, wish, kLookAhead)) >= here) return {wish, false, ""};
    return {
        {},
        true,
        fmt::format("geofence: the robot reaches {:.2f} m over the border; drive it back", -here)};
  }
  // The way to a stop at a share k of the wish: k v reaction + (k v)^2 / (2 decel), by time.
  const auto stopsInside = [&](double k) {
    const Twist2 v = scaled(wish, k);
    const double lever = 1.0;  // 1 rad/s counts as 1 m/s
    const double speed = std::hypot(v.vx_mps, v.vy_mps, lever * v.wz_radps);
    const double time = config_.reaction_s + 0.5 * speed / config_.decel_mps2;
    return room(after(X_map_base, v, time)) >= 0.0 && room(after(X_map_base, v, 0.5 * time)) >= 0.0;
  };
  if (stopsInside(1.0)) return {wish, false, ""};
  double low = 0.0, high = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (stopsInside(middle) ? low : high) = middle;
  }
  return {scaled(wish, low), true, fmt::format("geofence: the border is {:.2f} m away", here)};
}

}  // namespace kiln
