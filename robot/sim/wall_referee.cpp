#include "robot/sim/wall_referee.h"

#include <cmath>

#include "common/core/units.h"

namespace kiln::sim {
namespace {

constexpr double kNear_m = 0.05, kNear_rad = 5.0 * kDeg;
constexpr double kLevelCosine = 0.9962;  // 5 deg
constexpr double kFrameReach_m = 2.0, kFrameReach_rad = 20.0 * kDeg;

/// A brick is the same turned by half a turn.
double halfTurn(double a) { return std::remainder(a, M_PI); }

struct Flat {
  Pose2 X;
  double z = 0.0;  ///< of its middle, above the marker's ground
};

Flat flat(const Eigen::Isometry3d& X) { return {projectToGround(X), X.translation().z()}; }

struct Match {
  std::size_t slot = 0, brick = 0;
};

struct Task {
  std::span<const WallSlot> slots;
  std::span<const LyingBrick> bricks;
  std::vector<Flat> slot_poses, brick_poses;  ///< in wall; in the marker's frame
  std::vector<bool> level;
};

bool fits(const Task& t, const Pose2& X_marker_wall, std::size_t slot, std::size_t brick) {
  if (t.slots[slot].kind != t.bricks[brick].kind || !t.level[brick]) return false;
  const Pose2 X = X_marker_wall * t.slot_poses[slot].X;
  const Flat& b = t.brick_poses[brick];
  return std::hypot(b.X.x_m - X.x_m, b.X.y_m - X.y_m) <= kNear_m &&
         std::fabs(b.z - t.slot_poses[slot].z) <= kNear_m &&
         std::fabs(halfTurn(b.X.yaw_rad - X.yaw_rad)) <= kNear_rad;
}

std::vector<Match> matches(const Task& t, const Pose2& X_marker_wall, bool first_layer) {
  std::vector<Match> out;
  std::vector<bool> used(t.bricks.size(), false);
  for (std::size_t s = 0; s < t.slots.size(); ++s) {
    if (first_layer && t.slots[s].layer != 0) continue;
    for (std::size_t b = 0; b < t.bricks.size(); ++b) {
      if (used[b] || !fits(t, X_marker_wall, s, b)) continue;
      used[b] = true;
      out.push_back({s, b});
      break;
    }
  }
  return out;
}

/// Least squares over the middles; the yaw of a single brick by itself.
Pose2 fit(const Task& t, const std::vector<Match>& found) {
  Eigen::Vector2d mean_slot = Eigen::Vector2d::Zero(), mean_brick = Eigen::Vector2d::Zero();
  const double n = static_cast<double>(found.size());
  const auto middle = [](const Flat& f) { return Eigen::Vector2d(f.X.x_m, f.X.y_m); };
  for (const Match& m : found) {
    mean_slot += middle(t.slot_poses[m.slot]) / n;
    mean_brick += middle(t.brick_poses[m.brick]) / n;
  }
  double along = 0.0, across = 0.0;
  for (const Match& m : found) {
    const Eigen::Vector2d a = middle(t.slot_poses[m.slot]) - mean_slot,
                          b = middle(t.brick_poses[m.brick]) - mean_brick;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
    // The bricks' own headings count as two points half a brick from the middle.
    const double half = 0.5 * brickShape(t.slots[m.slot].kind).length_m;
    const double turn = halfTurn(t.brick_poses[m.brick].X.yaw_rad - t.slot_poses[m.slot].X.yaw_rad);
    along += half * half * std::cos(turn);
    across += half * half * std::sin(turn);
  }
  const double yaw = std::atan2(across, along);
  const Eigen::Vector2d p = mean_brick - Eigen::Rotation2Dd(yaw) * mean_slot;
  return {p.x(), p.y(), yaw};
}

bool nearMarker(const Pose2& X) {
  return std::hypot(X.x_m, X.y_m) <= kFrameReach_m &&
         std::fabs(wrapAngle(X.yaw_rad)) <= kFrameReach_rad;
}

/// Every brick of the first layer as every slot of its kind; the frame that most others agree with.
std::optional<Pose2> findFrame(const Task& t) {
  std::vector<Match> best;
  for (std::size_t s = 0; s < t.slots.size(); ++s) {
    if (t.slots[s].layer != 0) continue;
    for (std::size_t b = 0; b < t.bricks.size(); ++b) {
      if (t.slots[s].kind != t.bricks[b].kind || !t.level[b]) continue;
      const double turn = halfTurn(t.brick_poses[b].X.yaw_rad - t.slot_poses[s].X.yaw_rad);
      const Pose2 X =
          Pose2{t.brick_poses[b].X.x_m, t.brick_poses[b].X.y_m, t.slot_poses[s].X.yaw_rad + turn} *
          inverse(t.slot_poses[s].X);
      if (!nearMarker(X)) continue;
      std::vector<Match> found = matches(t, X, true);
      if (found.size() > best.size()) best = std::move(found);
    }
  }
  if (best.empty()) return std::nullopt;
  Pose2 X = fit(t, best);
  for (int i = 0; i < 3; ++i) {
    const auto again = matches(t, X, true);
    if (again.empty()) break;
    X = fit(t, again);
  }
  return X;
}

}  // namespace

WallScore scoreWall(std::span<const WallSlot> slots, std::span<const LyingBrick> bricks,
                    const Eigen::Isometry3d& X_map_marker) {
  Task t{slots, bricks, {}, {}, {}};
  for (const WallSlot& slot : slots) t.slot_poses.push_back(flat(slot.X_wall_brick));
  for (const LyingBrick& brick : bricks) {
    const Eigen::Isometry3d X = X_map_marker.inverse() * brick.X_map_brick;
    t.brick_poses.push_back(flat(X));
    t.level.push_back(std::fabs(X.linear()(2, 2)) >= kLevelCosine);
  }
  WallScore score;
  score.brick_in_slot.resize(slots.size());
  const auto X_marker_wall = findFrame(t);
  if (!X_marker_wall) return score;
  const Pose2 X_map_flat = projectToGround(X_map_marker);
  score.X_map_wall = X_map_flat * *X_marker_wall;
  score.off_marker_m = std::hypot(X_marker_wall->x_m, X_marker_wall->y_m);
  score.off_marker_rad = std::fabs(wrapAngle(X_marker_wall->yaw_rad));
  for (const Match& m : matches(t, *X_marker_wall, false)) {
    score.brick_in_slot[m.slot] = m.brick;
    ++score.placed;
    score.points += brickShape(slots[m.slot].kind).points;
  }
  return score;
}

}  // namespace kiln::sim
