#include "robot/missions/wall/pile_bricks.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace kiln {
namespace {

constexpr double kSpread_m = 0.4;     // of the pairs: less does not tell a turn
constexpr double kElsewhere_m = 0.1;  // what seems farther from its place was moved
constexpr double kBias_m = 0.004;     // that more looks do not average out
constexpr double kWheels_m = 0.03;    // one sigma of a drive
constexpr double kAcross_m = 0.006;   // one sigma of a brick across its length

bool trustedIn(const PileBrick& brick, double trusted) {
  return !brick.taken && brick.confidence > trusted;
}

/// Across its length and turned as it is seen now; along it the mean of both, by their variances.
PileBrick fused(const PileBrick& before, const PileBrick& now) {
  PileBrick out = now;
  const double b = std::max(before.along_m * before.along_m, kBias_m * kBias_m);
  const double n = now.along_m * now.along_m;
  const Eigen::Vector3d along = now.X_map_brick.linear().col(0);
  const Eigen::Vector3d off = before.X_map_brick.translation() - now.X_map_brick.translation();
  out.X_map_brick.translation() += n / (b + n) * off.dot(along) * along;
  out.along_m = std::sqrt(b * n / (b + n));
  return out;
}

}  // namespace

double alongSigma(const BrickEstimate& brick) {
  const Eigen::Vector2d along = brick.X_base_brick.linear().col(0).head<2>();
  const double variance = along.dot(brick.covariance.topLeftCorner<2, 2>() * along);
  return std::clamp(std::sqrt(std::max(variance, 0.0)), 1e-3, 1.0);
}

CommonMotion commonMotion(const std::vector<PileBrick>& before, const std::vector<PileBrick>& seen,
                          double trusted) {
  struct Pair {
    Eigen::Vector2d from, to;
    Eigen::Matrix2d information;
  };
  std::vector<Pair> pairs;
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = a;
  for (std::size_t i = 0; i < std::min(before.size(), seen.size()); ++i) {
    if (!trustedIn(before[i], trusted) || !trustedIn(seen[i], trusted)) continue;
    const Eigen::Vector2d along = seen[i].X_map_brick.linear().col(0).head<2>().normalized();
    const Eigen::Vector2d across(-along.y(), along.x());
    const double s = seen[i].along_m;
    pairs.push_back({before[i].X_map_brick.translation().head<2>(),
                     seen[i].X_map_brick.translation().head<2>(),
                     along * along.transpose() / (s * s) +
                         across * across.transpose() / (kAcross_m * kAcross_m)});
    a += pairs.back().from;
    b += pairs.back().to;
  }
  const double n = std::max<double>(1.0, static_cast<double>(pairs.size()));
  a /= n;
  b /= n;
  double dot = 0.0, cross = 0.0, spread_m = 0.0;
  for (const Pair& pair : pairs) {
    const Eigen::Vector2d u = pair.from - a, v = pair.to - b;
    dot += u.dot(v);
    cross += u.x() * v.y() - u.y() * v.x();
    spread_m = std::max(spread_m, u.norm());
  }
  const Eigen::Rotation2Dd turn(spread_m >= kSpread_m ? std::atan2(cross, dot) : 0.0);
  Eigen::Matrix2d information = Eigen::Matrix2d::Identity() / (kWheels_m * kWheels_m);
  Eigen::Vector2d weighted = Eigen::Vector2d::Zero();
  for (const Pair& pair : pairs) {
    information += pair.information;
    weighted += pair.information * (pair.to - a - turn * (pair.from - a));
  }
  CommonMotion out;
  out.covariance = information.inverse();
  out.X.linear().topLeftCorner<2, 2>() = turn.toRotationMatrix();
  out.X.translation().head<2>() = a + out.covariance * weighted - turn * a;
  return out;
}

std::vector<PileBrick> merged(const std::vector<PileBrick>& before,
                              const std::vector<PileBrick>& seen, double trusted, bool stood) {
  if (before.empty()) return seen;
  const CommonMotion moved = stood ? CommonMotion{} : commonMotion(before, seen, trusted);
  std::vector<PileBrick> out = before;
  for (std::size_t i = 0; i < out.size(); ++i) {
    PileBrick& brick = out[i];
    if (brick.taken) continue;
    brick.X_map_brick = moved.X * brick.X_map_brick;
    const Eigen::Vector2d along = brick.X_map_brick.linear().col(0).head<2>();
    brick.along_m = std::hypot(brick.along_m, std::sqrt(along.dot(moved.covariance * along)));
    if (i >= seen.size()) continue;
    const PileBrick& now = seen[i];
    if (now.state == BrickState::Excluded || now.state == BrickState::Unseen) continue;
    const double off_m = (now.X_map_brick.translation() - brick.X_map_brick.translation()).norm();
    if (off_m > kElsewhere_m || !trustedIn(brick, trusted)) {
      brick = now;
      continue;
    }
    const PileBrick known = brick;
    if (now.state == BrickState::Found || now.state == BrickState::Uncertain)
      brick = fused(known, now);
    else
      brick = now;
    if (now.state == BrickState::Uncertain) {  // seen vaguely, but where it was
      brick.state = known.state;
      brick.confidence = known.confidence;
    }
  }
  return out;
}

}  // namespace kiln
