#include "robot/perception/bricks/brick_poses.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/perception/bricks/brick_alignment.h"
#include "robot/perception/bricks/brick_tilt.h"
#include "robot/perception/bricks/loose_bodies.h"

namespace kiln {
namespace {

constexpr double kTrusted = 0.7;      // from it on a brick may be gripped
constexpr double kFallenTrust = 0.5;  // a loose body's pose is a coarse one
constexpr double kFallenSigma_m = 0.1, kFallenSigma_rad = 0.3;
constexpr int kFewPoints = 60;  // of a free fit

/// (theta, x, y, z) to (x, y, z, yaw).
Eigen::Matrix4d reordered(const Eigen::Matrix4d& c) {
  static const Eigen::Vector4i from(1, 2, 3, 0);
  Eigen::Matrix4d out;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) out(i, j) = c(from[i], from[j]);
  return out;
}

struct Judgement {
  BrickState state = BrickState::Unseen;
  double confidence = 0.0;
};

/// What the figures of one brick amount to. The confidence is the paper's ratio, lowered for each
/// reason by which the pose may be wrong all the same.
Judgement judge(const BrickPoseEstimator::Config& config, const BrickEstimate& brick,
                const UprightMotion& motion) {
  const SurfaceEvidence& e = brick.evidence;
  if (e.expected < config.min_expected) return {BrickState::Unseen, 0.0};
  const double cells = e.expected;
  if (e.empty > e.found && e.empty > 0.4 * cells) return {BrickState::Missing, 0.0};
  const bool strayed = motion.tail<3>().norm() > config.max_shift_m ||
                       std::abs(motion[0]) > config.max_turn_deg * kDeg;
  double trust = e.found / cells * (1.0 - e.empty / cells);
  const double worst = std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
                                     brick.covariance.topLeftCorner<3, 3>(), Eigen::EigenvaluesOnly)
                                     .eigenvalues()[2]);
  trust *= std::min(1.0, std::pow(config.trust_sigma_m / worst, 2));
  trust *= std::min(1.0, cells / (2.0 * config.min_expected));
  if (brick.tilt_rad > config.max_tilt_deg * kDeg)
    return {BrickState::Tilted, std::min(0.5, trust)};
  if (strayed) return {BrickState::Uncertain, std::min(0.3, trust)};
  if (e.found < config.min_found * cells) return {BrickState::Uncertain, trust};
  return {trust >= kTrusted ? BrickState::Found : BrickState::Uncertain, trust};
}

}  // namespace

std::string_view toString(BrickState state) {
  switch (state) {
    case BrickState::Found:
      return "found";
    case BrickState::Uncertain:
      return "uncertain";
    case BrickState::Tilted:
      return "tilted";
    case BrickState::Missing:
      return "missing";
    case BrickState::Fallen:
      return "fallen";
    case BrickState::Unseen:
      return "unseen";
    case BrickState::Excluded:
      return "excluded";
  }
  return "?";
}

void BrickPoseEstimator::Config::visit(ConfigArchive& a) {
  a.field("nearest_neighbours", nearest_neighbours, "the paper's correspondences and normals");
  a.field("use_outline", use_outline, "edges behind which the LiDAR sees past a brick");
  a.field("distances_m", distances_m, "m", 0.005, 1, "lambda_dist, stage by stage", false);
  a.field("min_cosine", min_cosine, "", -1, 1, "lambda_dot, of model and measured normal");
  a.field("lateral_m", lateral_m, "m", 0, 0.2, "beside a face: still its point");
  a.field("max_iterations", max_iterations, "", 1, 200, "over all stages");
  a.field("max_correspondences", max_correspondences, "", 20, 100000, "of a brick");
  a.field("touch_m", touch_m, "m", 0, 0.1, "nearer bricks touch");
  a.field("stiffness_yaw", stiffness.yaw, "", 0, 1e3, "lambda_r");
  a.field("stiffness_x", stiffness.shift.x(), "", 0, 1e3, "lambda_t, along the base's X");
  a.field("stiffness_y", stiffness.shift.y(), "", 0, 1e3, "lambda_t, along the base's Y");
  a.field("stiffness_z", stiffness.shift.z(), "", 0, 1e3, "lambda_t, upwards");
  a.field("hold_yaw", hold.yaw, "", 0, 1e3, "of a brick's initial yaw");
  a.field("hold_x", hold.shift.x(), "", 0, 1e3, "of a brick's initial place, along the base's X");
  a.field("hold_y", hold.shift.y(), "", 0, 1e3, "of a brick's initial place, along the base's Y");
  a.field("hold_z", hold.shift.z(), "", 0, 1e3, "of a brick's initial height");
  a.field("min_weight", min_weight, "", 0.001, 1e5, "M(j) at least");
  a.field("ground_weight", ground_weight, "", 0, 1e5, "of the lowest layer's height");
  a.field("outline_weight", outline_weight, "", 0, 1e5, "of one stretch of outline");
  a.field("min_expected", min_expected, "", 1, 100000, "cells in sight; fewer: unseen");
  a.field("max_shift_m", max_shift_m, "m", 0.01, 2, "from the start; more: not this brick");
  a.field("max_turn_deg", max_turn_deg, "deg", 1, 90, "from the start; more: not this brick");
  a.field("max_tilt_deg", max_tilt_deg, "deg", 0.5, 45, "more: tilted");
  a.field("min_found", min_found, "", 0, 1, "of the expected cells; less: uncertain");
  a.field("sigma_m", sigma_m, "m", 0.001, 1, "of one point, for the covariance");
  a.field("touch_sigma_deg", touch_sigma_deg, "deg", 0.01, 45, "of two touching bricks");
  a.field("touch_sigma_m", touch_sigma_m, "m", 0.0001, 1, "of two touching bricks");
  a.field("touch_sigma_up_m", touch_sigma_up_m, "m", 0.0001, 1, "of two touching bricks");
  a.field("start_sigma_m", start_sigma_m, "m", 0.001, 1, "of a brick that nothing holds");
  a.field("start_sigma_deg", start_sigma_deg, "deg", 0.1, 90, "of a brick that nothing holds");
  a.field("trust_sigma_m", trust_sigma_m, "m", 0.001, 1, "a larger one lowers the confidence");
  a.section("gates", gates, "how beams are told apart at a surface");
}

BrickPoseEstimator::Config BrickPoseEstimator::Config::paper() {
  Config config;
  config.nearest_neighbours = true;
  config.use_outline = false;
  config.max_correspondences = 100000;
  config.stiffness = {0.01, Eigen::Vector3d::Constant(0.05)};
  return config;
}

BrickPoseEstimator::BrickPoseEstimator(const Config& config, const Clock* clock)
    : config_(config), clock_(clock), model_({}) {}

namespace {

std::vector<std::size_t> missingOnes(const BrickAlignment& alignment,
                                     const BrickPoseEstimator::Config& config,
                                     const std::vector<bool>& free) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < alignment.size(); ++i) {
    if (!free[i] || alignment.gone(i)) continue;
    const SurfaceEvidence e = alignment.evidence(i);
    if (e.expected >= config.min_expected && e.empty > e.found && e.empty > 0.4 * e.expected)
      out.push_back(i);
  }
  return out;
}

/// A missing brick's place is taken by the loose body that it may be; nearest first.
void findFallen(const PreparedSweep& sweep, const BrickAlignment& alignment,
                std::vector<BrickEstimate>& bricks) {
  std::vector<LooseBody> bodies = looseBodies(sweep, alignment.owners(), alignment.bricksThere());
  for (BrickEstimate& brick : bricks) {
    if (brick.state != BrickState::Missing || bodies.empty()) continue;
    const Eigen::Vector3d place = sweep.X_base_level.inverse() * brick.X_base_brick.translation();
    const auto at =
        std::min_element(bodies.begin(), bodies.end(), [&](const LooseBody& a, const LooseBody& b) {
          const auto rank = [&](const LooseBody& body) {
            return (mayBe(body, brick.kind) ? 0.0 : 1e6) + (body.centre - place).norm();
          };
          return rank(a) < rank(b);
        });
    if (!mayBe(*at, brick.kind)) continue;
    brick.state = BrickState::Fallen;
    brick.X_base_brick = sweep.X_base_level * makePose(at->centre, {0, 0, at->yaw_rad});
    brick.covariance =
        Eigen::Vector4d(kFallenSigma_m, kFallenSigma_m, kFallenSigma_m, kFallenSigma_rad)
            .array()
            .square()
            .matrix()
            .asDiagonal();
    brick.confidence = std::min(kFallenTrust, at->points / 1000.0);
    bodies.erase(at);
  }
}

}  // namespace

Result<BrickPoses> BrickPoseEstimator::estimate(const PreparedSweep& sweep,
                                                const BrickTarget& target,
                                                const Eigen::Isometry3d& X_level_target) {
  std::vector<ModelBrick> start;
  std::vector<bool> free;
  for (const TargetBrick& brick : target.bricks) {
    start.push_back({brick.id, brick.kind, X_level_target * brick.X_target_brick});
    free.push_back(!brick.excluded);
  }
  BrickAlignment alignment(config_, sweep, model_, start, free, clock_);
  bool seen = false;
  for (std::size_t i = 0; i < start.size(); ++i) {
    int cells = 0;
    for (const FaceGrid& face : alignment.lattice(i))
      cells += static_cast<int>(std::count(face.visible.begin(), face.visible.end(), 1));
    seen = seen || (free[i] && cells >= config_.min_expected);
  }
  if (!seen)
    return makeError(ErrorCode::Degenerate, "none of the {} bricks is in sight of the LiDAR",
                     start.size());

  alignment.run(1.0, config_.max_iterations);
  alignment.render();
  const std::vector<std::size_t> missing = config_.nearest_neighbours
                                               ? std::vector<std::size_t>{}
                                               : missingOnes(alignment, config_, free);
  std::vector<SurfaceEvidence> evidence_of_missing(start.size());
  if (!missing.empty()) {
    for (const std::size_t i : missing) evidence_of_missing[i] = alignment.evidence(i);
    alignment.remove(missing);
    alignment.run(config_.distances_m.front(), 2 * config_.max_iterations);
    alignment.render();
  }

  BrickPoses out;
  const std::vector<Eigen::Matrix4d> covariances = alignment.covariances();
  for (std::size_t i = 0; i < start.size(); ++i) {
    BrickEstimate brick;
    brick.id = start[i].id;
    brick.kind = start[i].kind;
    const ModelBrick now = alignment.brick(i);
    brick.X_base_brick = sweep.X_base_level * now.X_world_brick;
    brick.covariance = reordered(covariances[i]);
    if (!free[i]) {
      brick.state = BrickState::Excluded;
      out.bricks.push_back(brick);
      continue;
    }
    brick.evidence = alignment.gone(i) ? evidence_of_missing[i] : alignment.evidence(i);
    if (brick.evidence.expected > 0) brick.found_share = alignment.foundByNeighbours(i);
    if (config_.nearest_neighbours) {
      brick.confidence = brick.found_share;
      brick.state = brick.found_share >= kTrusted ? BrickState::Found : BrickState::Uncertain;
    } else {
      if (!alignment.gone(i) && brick.evidence.found >= kFewPoints / 2) {
        const FreeFit freely = fitFreely(sweep, now, alignment.lattice(i), config_.sigma_m / 3.0);
        if (freely.tilt_rad > 3.0 * freely.tilt_sigma_rad) brick.tilt_rad = freely.tilt_rad;
      }
      const Judgement judged = judge(config_, brick, alignment.motion(i));
      brick.state = judged.state;
      brick.confidence = judged.confidence;
    }
    out.bricks.push_back(brick);
  }
  if (!config_.nearest_neighbours) findFallen(sweep, alignment, out.bricks);
  out.iterations = alignment.iterations();
  const double per = 1e3 / std::max(1, out.iterations);
  out.iteration_ms = per * alignment.seconds();
  out.solve_ms = per * alignment.solveSeconds();
  return out;
}

}  // namespace kiln
