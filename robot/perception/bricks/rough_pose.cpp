#include "robot/perception/bricks/rough_pose.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

#include "common/geom/pose.h"
#include "robot/perception/bricks/block_cost.h"
#include "robot/perception/bricks/point_tree.h"

namespace kiln {
namespace {

constexpr double kStill_m = 5e-4, kStill_rad = 2e-4;  // a step this small ends a stage
constexpr float kBeside_m = 0.05F;                    // overlap is counted within it
constexpr int kScorePoints = 600, kExplainPoints = 1500;

/// E_dir = (1 - (R e_x) . l)^2, weighted.
class DirectionCost final : public ceres::SizedCostFunction<1, 4> {
 public:
  DirectionCost(const Eigen::Vector3d& x_axis, const Eigen::Vector3d& line, double weight)
      : x_axis_(x_axis), line_(line), root_(std::sqrt(weight)) {}
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const double cos = std::cos(x[0][0]), sin = std::sin(x[0][0]);
    const Eigen::Vector3d turned(cos * x_axis_.x() - sin * x_axis_.y(),
                                 sin * x_axis_.x() + cos * x_axis_.y(), x_axis_.z());
    residuals[0] = root_ * (1.0 - turned.dot(line_));
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      std::fill_n(jacobians[0], 4, 0.0);
      jacobians[0][0] = root_ * (turned.y() * line_.x() - turned.x() * line_.y());
    }
    return true;
  }

 private:
  Eigen::Vector3d x_axis_, line_;
  double root_;
};

Eigen::Isometry3d upright(const Eigen::Isometry3d& X_level_target) {
  const Eigen::Vector3d x = X_level_target.linear().col(0);
  return makePose({X_level_target.translation().x(), X_level_target.translation().y(), 0.0},
                  {0, 0, std::atan2(x.y(), x.x())});
}

Eigen::Isometry3d moved(const UprightMotion& motion, const Eigen::Vector3d& pivot) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(motion[0], Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X.translation() = pivot + motion.tail<3>() - X.linear() * pivot;
  return X;
}

}  // namespace

void RoughPoseEstimator::Config::visit(ConfigArchive& a) {
  a.field("far_m", far_m, "m", 0.05, 3, "first correspondence distance, point to plane");
  a.field("near_m", near_m, "m", 0.02, 3, "last correspondence distance, point to plane");
  a.field("close_m", close_m, "m", 0.01, 1, "correspondence distance, point to point");
  a.field("min_cosine", min_cosine, "", -1, 1, "of model and measured normal");
  a.field("max_iterations", max_iterations, "", 1, 200, "a stage");
  a.field("max_model_points", max_model_points, "", 100, 100000, "used of the model cloud");
  a.field("shift_m", shift_m, "m", 0, 2, "tried along the target's X, each side");
  a.field("shift_step_m", shift_step_m, "m", 0.02, 0.5, "between two trials");
  a.field("direction_weight", direction_weight, "", 0, 1e6, "of the marker's direction");
  a.field("hold", hold, "", 0, 100, "of where a stage began");
  a.field("ground_weight", ground_weight, "", 0, 100, "of the height over the ground");
  a.field("min_overlap", min_overlap, "", 0, 1, "less: refused");
  a.field("min_correspondences", min_correspondences, "", 10, 100000, "fewer: refused");
  a.field("sigma_m", sigma_m, "m", 0.001, 1, "of a correspondence, for the covariance");
}

RoughPoseEstimator::RoughPoseEstimator(const Config& config) : config_(config), model_({}) {}

SweepRegion RoughPoseEstimator::region(const BrickTarget& target, double margin_m) {
  SweepRegion region;
  region.X_base_region = target.X_base_target;
  region.low = Eigen::Vector3d::Constant(1e9);
  region.high = -region.low;
  for (const TargetBrick& brick : target.bricks) {
    const double reach = 0.5 * brickSize(brick.kind).head<2>().norm();
    const Eigen::Vector3d& p = brick.X_target_brick.translation();
    region.low = region.low.cwiseMin(p - Eigen::Vector3d(reach, reach, 0.5 * kBrickSide_m));
    region.high = region.high.cwiseMax(p + Eigen::Vector3d(reach, reach, 0.5 * kBrickSide_m));
  }
  region.low -= Eigen::Vector3d(margin_m, margin_m, 0.4);
  region.high += Eigen::Vector3d(margin_m, margin_m, 0.4);
  return region;
}

/// One estimation: measured points in a tree, the model at the current guess.
struct RoughPoseEstimator::Search {
  const Config& config;
  ModelCloudGenerator& generator;
  const PreparedSweep& sweep;
  const BrickTarget& target;
  PointTree tree;
  std::optional<Eigen::Vector3d> line;  // of the marker, level

  std::vector<ModelPoint> model;  // at X_level_target
  Eigen::Isometry3d X_level_target = Eigen::Isometry3d::Identity();
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  int iterations = 0;
  BrickBlock block;  // the last correspondences

  static std::vector<Eigen::Vector3f> positions(const std::vector<SurfacePoint>& surface) {
    std::vector<Eigen::Vector3f> out;
    for (const SurfacePoint& point : surface) out.push_back(point.p);
    return out;
  }
  Search(const Config& c, ModelCloudGenerator& g, const PreparedSweep& s, const BrickTarget& t)
      : config(c), generator(g), sweep(s), target(t), tree(positions(s.surface)) {
    if (t.front_line) line = (s.X_base_level.linear().transpose() * *t.front_line).normalized();
  }

  void render(const Eigen::Isometry3d& X);
  void correspond(const UprightMotion& motion, double radius_m, bool to_plane);
  [[nodiscard]] UprightMotion solve(const UprightMotion& start) const;
  [[nodiscard]] UprightMotion icp(UprightMotion motion, double from_m, double to_m, bool to_plane);
  [[nodiscard]] double overlap(const UprightMotion& motion, std::size_t stride) const;
  /// Share of the measured points around that lie beside the model, were it shifted.
  [[nodiscard]] double explained(const Eigen::Vector3d& shift, double margin_m) const;
  void advance(const UprightMotion& motion) { render(moved(motion, pivot) * X_level_target); }
};

void RoughPoseEstimator::Search::render(const Eigen::Isometry3d& X) {
  X_level_target = X;
  ModelWorld world;
  world.sensors = {sweep.p_level_sensor};
  for (const TargetBrick& brick : target.bricks)
    world.bricks.push_back({brick.id, brick.kind, X * brick.X_target_brick});
  const ModelCloud cloud = generator.generate(world);
  const std::size_t stride = std::max<std::size_t>(
      1, cloud.points.size() / static_cast<std::size_t>(config.max_model_points));
  model.clear();
  pivot.setZero();
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    model.push_back(cloud.points[i]);
    pivot += (cloud.points[i].p.cast<double>() - pivot) / static_cast<double>(model.size());
  }
}

void RoughPoseEstimator::Search::correspond(const UprightMotion& motion, double radius_m,
                                            bool to_plane) {
  const Eigen::Isometry3f X = moved(motion, pivot).cast<float>();
  block.centre = pivot;
  block.hold = {0.0, {config.hold, config.hold, 0.0}};
  block.correspondences.clear();
  for (const ModelPoint& point : model) {
    const std::uint32_t i = tree.nearest(X * point.p, static_cast<float>(radius_m));
    if (i == PointTree::kNone) continue;
    const SurfacePoint& q = sweep.surface[i];
    if (q.n.isZero() || q.n.dot(X.linear() * point.n) < static_cast<float>(config.min_cosine))
      continue;
    const Eigen::Vector3d p = point.p.cast<double>(), at = q.p.cast<double>();
    if (to_plane) {
      block.correspondences.push_back({p, at, q.n.cast<double>(), 1.0});
    } else {
      for (int k = 0; k < 3; ++k)
        block.correspondences.push_back({p, at, Eigen::Vector3d::Unit(k), 1.0 / 3.0});
    }
  }
}

UprightMotion RoughPoseEstimator::Search::solve(const UprightMotion& start) const {
  BrickBlock held = block;
  held.correspondences.push_back(
      {pivot, pivot, Eigen::Vector3d::UnitZ(), config.ground_weight * block.weightSum()});
  UprightMotion motion = start;
  ceres::Problem problem;
  problem.AddResidualBlock(newBlockCost(held), nullptr, motion.data());
  if (line)
    problem.AddResidualBlock(
        new DirectionCost(X_level_target.linear().col(0), *line, config.direction_weight), nullptr,
        motion.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.parameter_tolerance = config.solve.parameter_tolerance;
  options.function_tolerance = config.solve.function_tolerance;
  options.max_num_iterations = config.solve.max_iterations;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return motion;
}

UprightMotion RoughPoseEstimator::Search::icp(UprightMotion motion, double from_m, double to_m,
                                              bool to_plane) {
  double radius = from_m;
  for (int i = 0; i < config.max_iterations; ++i) {
    correspond(motion, radius, to_plane);
    if (block.correspondences.size() < 12) break;
    const UprightMotion before = motion;
    motion = solve(motion);
    ++iterations;
    const bool still = std::abs(motion[0] - before[0]) < kStill_rad &&
                       (motion - before).tail<3>().norm() < kStill_m;
    if (still && radius <= to_m) break;
    radius = std::max(to_m, 0.75 * radius);
  }
  return motion;
}

double RoughPoseEstimator::Search::overlap(const UprightMotion& motion, std::size_t stride) const {
  const Eigen::Isometry3f X = moved(motion, pivot).cast<float>();
  int asked = 0, met = 0;
  for (std::size_t i = 0; i < model.size(); i += stride) {
    ++asked;
    const std::uint32_t q = tree.nearest(X * model[i].p, kBeside_m);
    if (q != PointTree::kNone &&
        sweep.surface[q].n.dot(X.linear() * model[i].n) > static_cast<float>(config.min_cosine))
      ++met;
  }
  return asked > 0 ? static_cast<double>(met) / asked : 0.0;
}

double RoughPoseEstimator::Search::explained(const Eigen::Vector3d& shift, double margin_m) const {
  std::vector<Eigen::Vector3f> points;
  for (const ModelPoint& point : model) points.push_back(point.p + shift.cast<float>());
  const PointTree own(points);
  const SweepRegion around = RoughPoseEstimator::region(target, margin_m);
  const Eigen::Isometry3f X_target_level = X_level_target.inverse().cast<float>();
  const std::size_t stride =
      std::max<std::size_t>(1, sweep.surface.size() / static_cast<std::size_t>(kExplainPoints));
  int asked = 0, met = 0;
  for (std::size_t i = 0; i < sweep.surface.size(); i += stride) {
    const Eigen::Vector3f p = X_target_level * sweep.surface[i].p;
    if ((p.array() < around.low.cast<float>().array()).any() ||
        (p.array() > around.high.cast<float>().array()).any())
      continue;
    ++asked;
    if (own.nearest(sweep.surface[i].p, 2.0F * kBeside_m) != PointTree::kNone) ++met;
  }
  return asked > 0 ? static_cast<double>(met) / asked : 0.0;
}

Result<RoughPose> RoughPoseEstimator::estimate(const PreparedSweep& sweep,
                                               const BrickTarget& target) {
  if (target.bricks.empty())
    return makeError(ErrorCode::InvalidInput, "no brick to look for: the target is empty");
  if (!isFinite(target.X_base_target))
    return makeError(ErrorCode::InvalidInput, "the target's expected pose is not finite");
  Search search(config_, model_, sweep, target);
  search.render(upright(sweep.X_base_level.inverse() * target.X_base_target));
  if (static_cast<int>(search.model.size()) < config_.min_correspondences)
    return makeError(ErrorCode::Degenerate,
                     "the target is not in sight of the LiDAR: {} model points, {} needed",
                     search.model.size(), config_.min_correspondences);

  const UprightMotion first =
      search.icp(UprightMotion::Zero(), config_.far_m, config_.near_m, true);
  search.advance(first);
  // Stacks look alike: a model that is one stack off fits most faces as well, but not the ends.
  const Eigen::Vector3d along = search.X_level_target.linear().col(0);
  const std::size_t stride = std::max<std::size_t>(1, search.model.size() / kScorePoints);
  UprightMotion best = UprightMotion::Zero();
  double best_score = -1.0;
  const int steps = static_cast<int>(std::lround(config_.shift_m / config_.shift_step_m));
  for (int k = -steps; k <= steps; ++k) {
    UprightMotion shifted = UprightMotion::Zero();
    shifted.tail<3>() = k * config_.shift_step_m * along;
    // What is expected must be there, and what is there expected. Nothing gained: rather no shift.
    const double score = search.overlap(shifted, stride) +
                         search.explained(shifted.tail<3>(), config_.shift_m) - 1e-3 * std::abs(k);
    if (score <= best_score) continue;
    best_score = score;
    best = shifted;
  }
  search.advance(best);
  search.advance(search.icp(UprightMotion::Zero(), config_.near_m, config_.near_m, true));
  const UprightMotion last =
      search.icp(UprightMotion::Zero(), 2.0 * config_.close_m, config_.close_m, false);
  search.advance(last);
  search.correspond(UprightMotion::Zero(), config_.near_m, true);

  RoughPose out;
  out.X_level_target = search.X_level_target;
  out.X_base_target = sweep.X_base_level * search.X_level_target;
  out.iterations = search.iterations;
  out.correspondences = static_cast<int>(search.block.correspondences.size());
  out.overlap = search.overlap(UprightMotion::Zero(), 1);
  out.explained = search.explained(Eigen::Vector3d::Zero(), 0.15);
  if (out.correspondences < config_.min_correspondences)
    return makeError(ErrorCode::Degenerate,
                     "too few points on the target: {} correspondences, {} needed",
                     out.correspondences, config_.min_correspondences);
  if (out.overlap < config_.min_overlap)
    return makeError(ErrorCode::Degenerate,
                     "what the sweep shows is not the target, or it stands elsewhere: {:.0f} % of "
                     "the expected surface found, {:.0f} % needed; {:.0f} % of what is there was "
                     "expected",
                     100 * out.overlap, 100 * config_.min_overlap, 100 * out.explained);
  double squares = 0.0;
  for (const Correspondence& c : search.block.correspondences)
    squares += std::pow(c.n.dot(c.p - c.q), 2);
  out.rms_m = std::sqrt(squares / out.correspondences);
  const std::vector<UprightMotion> none(1, UprightMotion::Zero());
  const Eigen::Matrix4d own = brickCovariances({&search.block, 1}, {}, none, config_.sigma_m,
                                               Eigen::Vector4d::Ones(), {0.2, 0.5, 0.5, 0.1})[0];
  // From (yaw, x, y, z of the pivot) to (x, y, z, yaw of the target's origin).
  const Eigen::Vector3d lever = search.X_level_target.translation() - search.pivot;
  Eigen::Matrix4d J = Eigen::Matrix4d::Zero();
  J.block<3, 3>(0, 1).setIdentity();
  J(0, 0) = -lever.y();
  J(1, 0) = lever.x();
  J(3, 0) = 1.0;
  out.covariance = J * own * J.transpose();
  return out;
}

}  // namespace kiln
