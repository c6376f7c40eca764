#include "robot/localization/scan_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "common/core/check.h"
#include "common/core/units.h"
#include "common/geom/pose.h"

namespace kiln {
namespace {

constexpr double kUnobservable_m = 10.0;  // 1-sigma reported along a direction that nothing holds
constexpr double kConverged_m = 3e-4;
constexpr float kOutlier = 0.02F;     // likelihood of the outlier class: that of 2.8 sigma
constexpr int kFallbackLevels = 2;    // coarser levels asked where the wanted one is empty
constexpr float kPostEnd_m = 0.2F;    // above and below what was seen of a post
constexpr float kFloorNormal = 0.8F;  // Z of the normal: floors explain every pose

using Matrix6d = Eigen::Matrix<double, 6, 6>;

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& X, const Vector6d& step) {
  Eigen::Isometry3d out = X;
  out.translation() += step.head<3>();
  const double angle = step.tail<3>().norm();
  if (angle > 1e-12) {
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(angle, step.tail<3>() / angle).toRotationMatrix() * X.linear();
    out.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  }
  return out;
}

}  // namespace

void ScanMatcher::Config::visit(ConfigArchive& a) {
  a.field("patch_m", patch_m, "m", 0.02, 1, "cells to which a scan is thinned");
  a.field("max_patches", max_patches, "", 100, 30000, "after thinning");
  a.field("min_patches", min_patches, "", 10, 10000, "fewer are refused");
  a.field("max_range_m", max_range_m, "m", 1, 100, "farther points are ignored");
  a.field("sensor_sigma_m", sensor_sigma_m, "m", 0.001, 0.2, "of one patch");
  a.field("inlier_distance_m", inlier_distance_m, "m", 0.005, 1, "what a surfel explains");
  a.field("min_inlier_fraction", min_inlier_fraction, "", 0, 1, "fewer are refused");
  a.field("max_edges", max_edges, "", 0, 10000, "ends of surfaces, matched with the map's posts");
  a.field("min_information", min_information, "", 1, 1e4,
          "effective patches that must hold a direction");
  a.field("residual_sigma_m", residual_sigma_m, "m", 0.001, 1, "of one patch, in the covariance");
  a.field("floor_sigma_m", floor_sigma_m, "m", 0, 0.5, "least 1-sigma of the position");
  a.field("floor_sigma_deg", floor_sigma_deg, "deg", 0, 10, "least 1-sigma of the angles");
  a.field("search_radius_m", search_radius_m, "m", 0, 5, "half width of the search");
  a.field("search_angle_deg", search_angle_deg, "deg", 0, 180, "half width of the search");
  a.field("search_step_m", search_step_m, "m", 0.02, 1, "grid of the search");
  a.field("search_step_deg", search_step_deg, "deg", 0.2, 30, "grid of the search");
  a.field("search_patches", search_patches, "", 20, 10000, "looked at for each candidate");
  a.field("search_candidates", search_candidates, "", 1, 1000, "refined");
  a.field("ambiguity_margin", ambiguity_margin, "", 0.5, 1,
          "another place explained this well, relative to the best, is ambiguous");
}

/// One patch after assignment: its pull A (q - target), summed over the surfels it is shared among.
struct ScanMatcher::Share {
  Eigen::Matrix3f A = Eigen::Matrix3f::Zero();     ///< sum of w n n^T, unitless
  Eigen::Vector3f pull = Eigen::Vector3f::Zero();  ///< sum of w n (n . (q - mean)), metres
  float weight = 0.0F;                             ///< 0 = outlier, 1 = fully explained
  float squared = 0.0F;                            ///< sum of w (n . (q - mean))^2
  const Surfel* best = nullptr;                    ///< the likeliest one
  float best_distance_m = 0.0F;
};

struct ScanMatcher::Equations {
  Matrix6d H = Matrix6d::Zero();  ///< of (x y z, rotation vector) in map about the base centre
  Vector6d g = Vector6d::Zero();
  double lever_squared = 0.0, weight = 0.0;

  /// A pull A (q - target) = `pull` on a point q = base centre + lever.
  void add(const Eigen::Matrix3d& A, const Eigen::Vector3d& pull, const Eigen::Vector3d& lever,
           double w) {
    const Eigen::Matrix3d L = cross(lever), LA = L * A;  // dq = dt - L drotation
    H.topLeftCorner<3, 3>() += A;
    H.topRightCorner<3, 3>() += LA.transpose();
    H.bottomLeftCorner<3, 3>() += LA;
    H.bottomRightCorner<3, 3>() += LA * L.transpose();
    g.head<3>() += pull;
    g.tail<3>() += L * pull;
    weight += w;
    lever_squared += w * lever.squaredNorm();
  }
  /// Metres a rotation is worth: makes translations and rotations comparable.
  [[nodiscard]] double lever_m() const {
    return weight > 0.0 ? std::max(0.5, std::sqrt(lever_squared / weight)) : 1.0;
  }
  [[nodiscard]] Vector6d scale() const {
    const double s = 1.0 / lever_m();
    return (Vector6d() << 1, 1, 1, s, s, s).finished();
  }
};

/// Eigenvectors of the scaled information: which motions the scan holds, and how firmly.
struct ScanMatcher::Directions {
  Vector6d scale, information;
  Matrix6d vectors;
  int first_held = 0;  ///< the weaker ones, before it, are not held

  [[nodiscard]] int held() const { return 6 - first_held; }
  /// Least-squares step within the held directions.
  [[nodiscard]] Vector6d step(const Equations& equations) const {
    if (held() == 0) return Vector6d::Zero();
    const auto W = vectors.rightCols(held());
    const Matrix6d H = scale.asDiagonal() * equations.H * scale.asDiagonal();
    const Eigen::MatrixXd part = W.transpose() * H * W;
    return W * part.ldlt().solve(-W.transpose() * (scale.asDiagonal() * equations.g));
  }
  /// The part of a motion from `start` that nothing holds, undone.
  [[nodiscard]] Eigen::Isometry3d withoutDrift(const Eigen::Isometry3d& start,
                                               const Eigen::Isometry3d& X) const {
    const Eigen::AngleAxisd turn(X.linear() * start.linear().transpose());
    Vector6d motion;
    motion << X.translation() - start.translation(), turn.angle() * turn.axis();
    const auto weak = vectors.leftCols(first_held);
    return moved(X, scale.asDiagonal() *
                        -(weak * (weak.transpose() * scale.cwiseInverse().asDiagonal() * motion)));
  }
};

ScanMatcher::ScanMatcher(Config config, std::shared_ptr<const SurfelMap> map)
    : config_(config), map_(std::move(map)) {
  KILN_CHECK(map_ != nullptr, config_.max_patches);
}

Result<ScanMatcher::Scan> ScanMatcher::prepare(const PointCloud& scan_base,
                                               const Eigen::Isometry3d& X_map_base_prior,
                                               const Eigen::Vector3d& p_base_sensor) const {
  if (!isFinite(X_map_base_prior) || !p_base_sensor.allFinite())
    return makeError(ErrorCode::InvalidInput, "the pose prior is not finite");
  ScanReduction reduction;
  reduction.cell_m = config_.patch_m;
  reduction.max_range_m = config_.max_range_m;
  reduction.max_surfels = config_.max_patches;
  Scan scan{reduceScan(scan_base, p_base_sensor, reduction), {}};
  if (static_cast<int>(scan.patches.size()) < config_.min_patches) {
    return makeError(ErrorCode::Degenerate,
                     "the scan of {} points has {} usable patches; {} are needed", scan_base.size(),
                     scan.patches.size(), config_.min_patches);
  }
  if (!map_->posts().empty()) scan.edges = findEdges(scan_base, p_base_sensor, config_.max_edges);
  return scan;
}

ScanMatcher::Share ScanMatcher::assign(const Eigen::Vector3f& q, const Eigen::Vector3f& view,
                                       int level, float spread_m) const {
  Share share;
  SurfelMap::Neighbours near;
  const int last = std::min(level + kFallbackLevels, map_->config().levels - 1);
  int used = level;
  for (; used <= last; ++used) {
    map_->gather(used, q, view, near);
    if (near.size > 0) break;
  }
  if (near.size == 0) return share;
  const auto sensor = static_cast<float>(config_.sensor_sigma_m);
  const auto cell = static_cast<float>(map_->cellSize(used));
  const float along_variance = 0.25F * cell * cell;
  std::array<float, 16> likelihood{};
  float sum = kOutlier, best = 0.0F;
  for (int j = 0; j < near.size; ++j) {
    const Surfel& surfel = *near.surfels[static_cast<std::size_t>(j)];
    const Eigen::Vector3f d = q - surfel.mean;
    const float normal = surfel.normal.dot(d);
    const float along2 = std::max(0.0F, d.squaredNorm() - normal * normal);
    const float variance = surfel.normal_variance + sensor * sensor + spread_m * spread_m;
    const float l = std::exp(
        -0.5F * (normal * normal / variance + along2 / (along_variance + surfel.extent_variance)));
    likelihood[static_cast<std::size_t>(j)] = l;
    sum += l;
    if (l > best) {
      best = l;
      share.best = &surfel;
      share.best_distance_m = normal;
    }
  }
  for (int j = 0; j < near.size; ++j) {
    const Surfel& surfel = *near.surfels[static_cast<std::size_t>(j)];
    const float w = likelihood[static_cast<std::size_t>(j)] / sum;
    if (w < 1e-3F) continue;
    const float normal = surfel.normal.dot(q - surfel.mean);
    // A thick surfel says less: relative to a thin one.
    const float trust = sensor * sensor / (sensor * sensor + surfel.normal_variance);
    const Eigen::Vector3f weighted = (w * trust) * surfel.normal;
    share.A += weighted * surfel.normal.transpose();
    share.pull += weighted * normal;
    share.squared += w * trust * normal * normal;
    share.weight += w * trust;
  }
  return share;
}

ScanMatcher::Equations ScanMatcher::linearise(const Scan& scan, const Eigen::Isometry3d& X_map_base,
                                              const Stage& stage) const {
  Equations out;
  const Eigen::Matrix3f R = X_map_base.linear().cast<float>();
  const Eigen::Vector3f t = X_map_base.translation().cast<float>();
  for (const ScanSurfel& patch : scan.patches) {
    const Eigen::Vector3f lever = R * patch.mean;
    const Share share =
        assign(lever + t, R * patch.view, stage.level, static_cast<float>(stage.spread_m));
    if (share.weight < 1e-3F) continue;
    const double w = patch.weight;
    out.add(w * share.A.cast<double>(), w * share.pull.cast<double>(), lever.cast<double>(),
            w * static_cast<double>(share.weight));
  }
  addEdges(scan.edges, X_map_base, stage, out);
  return out;
}

void ScanMatcher::addEdges(const std::vector<ScanEdge>& edges, const Eigen::Isometry3d& X_map_base,
                           const Stage& stage, Equations& equations) const {
  const Eigen::Matrix3f R = X_map_base.linear().cast<float>();
  const Eigen::Vector3f t = X_map_base.translation().cast<float>();
  const auto sensor = static_cast<float>(config_.sensor_sigma_m);
  const auto spread = static_cast<float>(stage.spread_m);
  for (const ScanEdge& edge : edges) {
    const Eigen::Vector3f lever = R * edge.p, q = lever + t;
    const Eigen::Vector2f free = (R * edge.free).head<2>();
    Eigen::Vector2f pull = Eigen::Vector2f::Zero();
    float weight = 0.0F, sum = kOutlier;
    for (const Post& post : map_->posts()) {
      const Eigen::Vector2f d = q.head<2>() - post.p;
      const float variance = post.variance + sensor * sensor + spread * spread;
      const float distance2 = d.squaredNorm() / variance;
      if (distance2 > 16.0F || post.free.dot(free) < 0.3F || q.z() < post.z_min - kPostEnd_m ||
          q.z() > post.z_max + kPostEnd_m) {
        continue;
      }
      const float likelihood = std::exp(-0.5F * distance2);
      const float w = likelihood * sensor * sensor / (sensor * sensor + post.variance);
      sum += likelihood;
      weight += w;
      pull += w * d;
    }
    if (weight < 1e-3F) continue;
    const double w = static_cast<double>(weight / sum);
    const Eigen::Matrix3d A = Eigen::Vector3d(w, w, 0).asDiagonal();
    equations.add(A, {static_cast<double>(pull.x() / sum), static_cast<double>(pull.y() / sum), 0},
                  lever.cast<double>(), w);
  }
}

ScanMatcher::Directions ScanMatcher::directions(const Equations& equations) const {
  Directions out;
  out.scale = equations.scale();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(out.scale.asDiagonal() * equations.H *
                                                       out.scale.asDiagonal());
  out.information = solver.eigenvalues();
  out.vectors = solver.eigenvectors();
  while (out.first_held < 6 && !(out.information[out.first_held] >= config_.min_information))
    ++out.first_held;
  return out;
}

void ScanMatcher::iterate(const Scan& scan, const Stage& stage, const Directions* held,
                          ScanMatch& match, Equations& equations) const {
  for (int i = 0; i < stage.iterations; ++i) {
    equations = linearise(scan, match.X_map_base, stage);
    const Directions free = held != nullptr ? *held : directions(equations);
    Vector6d step = free.step(equations);
    // Beyond its reach an assignment says nothing about how far to go.
    const double reach = std::max(0.05, 2.0 * map_->cellSize(stage.level));
    if (step.norm() > reach) step *= reach / step.norm();
    match.X_map_base = moved(match.X_map_base, free.scale.asDiagonal() * step);
    ++match.iterations;
    if (step.norm() < kConverged_m) break;
  }
}

ScanMatch ScanMatcher::refine(const Scan& scan, const Eigen::Isometry3d& start,
                              std::span<const Stage> stages) const {
  ScanMatch out;
  out.X_map_base = start;
  out.points = static_cast<int>(scan.patches.size());
  Equations equations;
  for (const Stage& stage : stages) iterate(scan, stage, nullptr, out, equations);
  Directions held = directions(equations);
  if (held.first_held > 0 && held.held() > 0) {
    // Coarse levels may have thought otherwise: back to the prior there, and once more in the rest.
    out.X_map_base = held.withoutDrift(start, out.X_map_base);
    iterate(scan, stages.back(), &held, out, equations);
    const int first_held = held.first_held;
    held = directions(equations);
    held.first_held = std::max(first_held, held.first_held);
  }
  conclude(held, out);
  countInliers(scan.patches, out);
  return out;
}

void ScanMatcher::conclude(const Directions& held, ScanMatch& match) const {
  Vector6d variance;
  for (int k = 0; k < 6; ++k) {
    variance[k] = k >= held.first_held
                      ? config_.residual_sigma_m * config_.residual_sigma_m / held.information[k]
                      : kUnobservable_m * kUnobservable_m;
  }
  match.observable_directions = held.held();
  const Matrix6d covariance = held.vectors * variance.asDiagonal() * held.vectors.transpose();
  match.covariance = held.scale.asDiagonal() * covariance * held.scale.asDiagonal();
  const double angle = config_.floor_sigma_deg * kDeg;
  match.covariance.diagonal().head<3>().array() += config_.floor_sigma_m * config_.floor_sigma_m;
  match.covariance.diagonal().tail<3>().array() += angle * angle;
}

void ScanMatcher::countInliers(std::span<const ScanSurfel> patches, ScanMatch& match) const {
  const Eigen::Matrix3f R = match.X_map_base.linear().cast<float>();
  const Eigen::Vector3f t = match.X_map_base.translation().cast<float>();
  const auto gate = static_cast<float>(config_.inlier_distance_m);
  double all = 0.0, inliers = 0.0, squares = 0.0;
  for (const ScanSurfel& patch : patches) {
    const Share share = assign(R * patch.mean + t, R * patch.view, 0, 0.5F * gate);
    const bool explained = share.best != nullptr && std::abs(share.best_distance_m) <= gate;
    if (explained && share.best->normal.z() > kFloorNormal) continue;
    all += static_cast<double>(patch.weight);
    if (!explained) continue;
    inliers += static_cast<double>(patch.weight);
    squares += static_cast<double>(patch.weight * share.best_distance_m * share.best_distance_m);
  }
  match.inlier_fraction = all > 0.0 ? inliers / all : 0.0;
  match.rms_m = inliers > 0.0 ? std::sqrt(squares / inliers) : 0.0;
}

Result<ScanMatch> ScanMatcher::judged(ScanMatch match, Stamp stamp) const {
  match.stamp = stamp;
  if (match.observable_directions == 0)
    return makeError(ErrorCode::Degenerate,
                     "the map near the prior holds no direction of the scan");
  if (match.inlier_fraction < config_.min_inlier_fraction) {
    return makeError(ErrorCode::Degenerate,
                     "the map explains only {:.0f} % of the scan; {:.0f} % are needed",
                     100.0 * match.inlier_fraction, 100.0 * config_.min_inlier_fraction);
  }
  return match;
}

Result<ScanMatch> ScanMatcher::match(const PointCloud& scan_base,
                                     const Eigen::Isometry3d& X_map_base_prior,
                                     const Eigen::Vector3d& p_base_sensor) const {
  const auto scan = prepare(scan_base, X_map_base_prior, p_base_sensor);
  if (!scan) return tl::make_unexpected(scan.error());
  const int coarse = std::min(2, map_->config().levels - 1), middle = std::min(1, coarse);
  const std::array<Stage, 3> stages{{{coarse, 0.10, 3}, {middle, 0.05, 4}, {0, 0.02, 8}}};
  return judged(refine(*scan, X_map_base_prior, stages), scan_base.stamp);
}

}  // namespace kiln
