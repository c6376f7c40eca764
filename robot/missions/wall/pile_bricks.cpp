#include "robot/missions/wall/pile_bricks.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace kiln {
namespace {

constexpr double kSpread_m = 0.4;     // of the pairs: less does not tell a turn
constexpr double kElsewhere_m = 0.1;  // what seems farther from its place was moved

bool trustedIn(const PileBrick& brick, double trusted) {
  return !brick.taken && brick.confidence > trusted;
}

/// Across its length and turned as it is seen now, along it where it was before.
PileBrick alongAsBefore(const PileBrick& now, const PileBrick& before) {
  PileBrick out = before;
  out.X_map_brick = now.X_map_brick;
  const Eigen::Vector3d along = now.X_map_brick.linear().col(0);
  const Eigen::Vector3d off = before.X_map_brick.translation() - now.X_map_brick.translation();
  out.X_map_brick.translation() += off.dot(along) * along;
  return out;
}

}  // namespace

Eigen::Isometry3d commonMotion(const std::vector<PileBrick>& before,
                               const std::vector<PileBrick>& seen, double trusted) {
  std::vector<Eigen::Vector2d> from, to;
  for (std::size_t i = 0; i < std::min(before.size(), seen.size()); ++i)
    if (trustedIn(before[i], trusted) && trustedIn(seen[i], trusted)) {
      from.emplace_back(before[i].X_map_brick.translation().head<2>());
      to.emplace_back(seen[i].X_map_brick.translation().head<2>());
    }
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  if (from.empty()) return out;
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = a;
  for (std::size_t i = 0; i < from.size(); ++i) {
    a += from[i] / static_cast<double>(from.size());
    b += to[i] / static_cast<double>(from.size());
  }
  double dot = 0.0, cross = 0.0, spread_m = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector2d u = from[i] - a, v = to[i] - b;
    dot += u.dot(v);
    cross += u.x() * v.y() - u.y() * v.x();
    spread_m = std::max(spread_m, u.norm());
  }
  const double turn = spread_m >= kSpread_m ? std::atan2(cross, dot) : 0.0;
  out.linear() = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  out.translation().head<2>() = b - (out.linear().topLeftCorner<2, 2>() * a);
  return out;
}

std::vector<PileBrick> merged(const std::vector<PileBrick>& before,
                              const std::vector<PileBrick>& seen, double trusted) {
  if (before.empty()) return seen;
  const Eigen::Isometry3d moved = commonMotion(before, seen, trusted);
  std::vector<PileBrick> out = before;
  for (std::size_t i = 0; i < out.size(); ++i) {
    PileBrick& brick = out[i];
    if (brick.taken) continue;
    brick.X_map_brick = moved * brick.X_map_brick;
    if (i >= seen.size()) continue;
    const PileBrick& now = seen[i];
    if (now.state == BrickState::Excluded || now.state == BrickState::Unseen) continue;
    const double off_m = (now.X_map_brick.translation() - brick.X_map_brick.translation()).norm();
    const bool vague =
        now.state == BrickState::Uncertain && off_m <= kElsewhere_m && trustedIn(brick, trusted);
    brick = vague ? alongAsBefore(now, brick) : now;
  }
  return out;
}

}  // namespace kiln
