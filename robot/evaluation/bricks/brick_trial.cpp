#include "robot/evaluation/bricks/brick_trial.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "common/geom/pose.h"

namespace kiln {
namespace {

constexpr double kNearest_m = 2.0, kFarthest_m = 3.5;
constexpr double kHeading_deg = 8.0, kLean_deg = 0.4;
constexpr double kLine2_m = 2.6, kMarkerMiddle_m = 0.21;

double uniform(SceneRandom& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Where the LiDAR stands and looks, in the target's frame.
struct View {
  double x_m, y_m, yaw_rad;
};

View drawView(const TrialOptions& options, const BrickScene& scene, double distance_m,
              SceneRandom& random) {
  double low = 1e9, high = -1e9;
  bool behind = options.kind == TrialKind::Pile && uniform(random, 0, 1) < 0.25;
  bool beside = options.kind == TrialKind::Wall && uniform(random, 0, 1) < 0.4;
  for (const TargetBrick& brick : scene.database) {
    const Eigen::Vector3d& p = brick.X_target_brick.translation();
    const bool second = p.y() > 1.0;
    if (options.kind == TrialKind::Pile && second != behind) continue;
    const double at = beside ? p.y() : p.x(), half = 0.5 * brickShape(brick.kind).length_m;
    low = std::min(low, at - half);
    high = std::max(high, at + half);
  }
  if (beside) low = 0.0;
  const double along = uniform(random, low + 0.2, std::max(low + 0.3, high - 0.2));
  const double turn = uniform(random, -kHeading_deg, kHeading_deg) * kDeg;
  const double face = 0.5 * kBrickSide_m;
  if (behind) return {along, kLine2_m + face + distance_m, -M_PI_2 + turn};
  if (beside) return {kMarkerMiddle_m - face - distance_m, along, turn};
  const double middle = options.kind == TrialKind::Wall ? kMarkerMiddle_m : 0.0;
  return {along, middle - face - distance_m, M_PI_2 + turn};
}

void excludeFar(const TrialOptions& options, const View& view, std::vector<TargetBrick>& bricks) {
  std::vector<std::pair<double, std::size_t>> far;
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    const Eigen::Vector3d& p = bricks[i].X_target_brick.translation();
    far.emplace_back(std::hypot(p.x() - view.x_m, p.y() - view.y_m), i);
  }
  std::stable_sort(far.begin(), far.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t k = 0; k < far.size(); ++k) {
    const double reach = std::hypot(options.reach_m, kFarthest_m);
    if (k >= options.max_bricks || far[k].first > reach) bricks[far[k].second].excluded = true;
  }
}

}  // namespace

BrickTrial makeTrial(const TrialOptions& options, std::uint64_t seed) {
  SceneRandom random(seed * 7919 + static_cast<std::uint64_t>(options.kind));
  BrickTrial trial;
  if (options.kind == TrialKind::Wall) {
    const auto placed = std::uniform_int_distribution<std::size_t>(6, 45)(random);
    trial.scene = makeWallScene(placed, random);
  } else {
    trial.scene = makePileScene(options.kind == TrialKind::Lab, random);
  }
  trial.target.bricks = trial.scene.database;
  if (options.disturbed > 0.0) disturb(trial.scene, options.disturbed, random);
  trial.distance_m = uniform(random, kNearest_m, kFarthest_m);
  const View view = drawView(options, trial.scene, trial.distance_m, random);
  excludeFar(options, view, trial.target.bricks);
  const double lean_x = uniform(random, -kLean_deg, kLean_deg) * kDeg,
               lean_y = uniform(random, -kLean_deg, kLean_deg) * kDeg;
  trial.X_world_base = trial.scene.X_world_target *
                       makePose({view.x_m, view.y_m, 0}, {0, 0, view.yaw_rad}) *
                       Eigen::Translation3d(-options.sensor.ahead_m, 0, 0) *
                       makePose({0, 0, 0}, {lean_x, lean_y, 0});
  trial.target.X_base_target =
      trial.X_world_base.inverse() * trial.scene.X_world_target *
      makePose({uniform(random, -options.prior_m, options.prior_m),
                uniform(random, -options.prior_m, options.prior_m), 0},
               {0, 0, uniform(random, -options.prior_deg, options.prior_deg) * kDeg});
  SweepSynthesis synthesis(options.sensor, random);
  trial.sweep = synthesis.sweep(trial.scene, trial.X_world_base);
  return trial;
}

std::vector<BrickOutcome> compare(const BrickTrial& trial, const BrickPoses& poses) {
  std::vector<BrickOutcome> out;
  for (const BrickEstimate& brick : poses.bricks) {
    if (brick.state == BrickState::Excluded) continue;
    BrickOutcome o;
    o.id = brick.id;
    o.kind = brick.kind;
    o.fate = trial.scene.fates[static_cast<std::size_t>(brick.id)];
    o.state = brick.state;
    o.confidence = brick.confidence;
    o.evidence = brick.evidence;
    const TrueBrick* const truth = trial.scene.find(brick.id);
    o.there = truth != nullptr;
    if (truth != nullptr) {
      const Eigen::Isometry3d X_base_true = trial.X_world_base.inverse() * truth->X_world_brick;
      o.off_m = (X_base_true.inverse() * brick.X_base_brick).translation();
      o.error_m = o.off_m.norm();
      const Eigen::Vector3d a = X_base_true.linear().col(0), b = brick.X_base_brick.linear().col(0);
      double turn = std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x());
      turn = std::remainder(turn, M_PI);  // a brick turned half around is the same
      o.yaw_error_deg = std::abs(turn) / kDeg;
      const Eigen::Vector3d off = X_base_true.translation() - brick.X_base_brick.translation();
      const Eigen::Matrix3d C = brick.covariance.topLeftCorner<3, 3>();
      o.normalised = std::sqrt(off.dot(C.ldlt().solve(off)) / 3.0);
    }
    out.push_back(o);
  }
  return out;
}

TargetError compareTarget(const BrickTrial& trial, const Eigen::Isometry3d& X_base_target) {
  const Eigen::Isometry3d off =
      (trial.X_world_base.inverse() * trial.scene.X_world_target).inverse() * X_base_target;
  return {off.translation().norm(), rotationAngle(off) / kDeg};
}

}  // namespace kiln
