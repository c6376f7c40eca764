#include "robot/localization/box_map_aligner.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kUnobservable_m = 10.0;  // 1-sigma reported along a direction that nothing holds
constexpr std::size_t kSearchPoints = 250;
constexpr std::size_t kRefinedCandidates = 6;
constexpr int kStages = 3;

bool finite(const Pose2& X) {
  return std::isfinite(X.x_m) && std::isfinite(X.y_m) && std::isfinite(X.yaw_rad);
}

Eigen::Vector2d rotate(double c, double s, const Eigen::Vector3d& p) {
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

Eigen::Vector2d transform(const Pose2& X, const Eigen::Vector3d& p) {
  return Eigen::Vector2d(X.x_m, X.y_m) + rotate(std::cos(X.yaw_rad), std::sin(X.yaw_rad), p);
}

}  // namespace

void BoxMapAligner::Config::visit(ConfigArchive& a) {
  a.field("z_min_m", z_min_m, "m", -1, 3, "lower points are ignored");
  a.field("z_max_m", z_max_m, "m", 0, 10, "higher points are ignored");
  a.field("max_range_m", max_range_m, "m", 1, 100, "farther points are ignored");
  a.field("voxel_m", voxel_m, "m", 0.02, 1, "thinning cell");
  a.field("max_points", max_points, "", 100, 30000, "after thinning");
  a.field("min_points", min_points, "", 3, 10000, "fewer are refused");
  a.field("coarse_gate_m", coarse_gate_m, "m", 0.05, 3, "first gate after a search");
  a.field("track_gate_m", track_gate_m, "m", 0.05, 3, "first gate while tracking");
  a.field("fine_gate_m", fine_gate_m, "m", 0.02, 1, "last gate");
  a.field("inlier_distance_m", inlier_distance_m, "m", 0.005, 1, "what a wall explains");
  a.field("min_inlier_fraction", min_inlier_fraction, "", 0, 1, "fewer are refused");
  a.field("max_iterations", max_iterations, "", 3, 200, "over all gates");
  a.field("min_information", min_information, "", 1, 1e4,
          "effective points that must hold a direction");
  a.field("residual_sigma_m", residual_sigma_m, "m", 0.001, 1, "of one point, in the covariance");
  a.field("floor_sigma_m", floor_sigma_m, "m", 0, 0.5, "least 1-sigma of the position");
  a.field("floor_sigma_deg", floor_sigma_deg, "deg", 0, 10, "least 1-sigma of the yaw");
  a.field("search_radius_m", search_radius_m, "m", 0, 3, "half width of the search");
  a.field("search_angle_deg", search_angle_deg, "deg", 0, 180, "half width of the search");
  a.field("search_step_m", search_step_m, "m", 0.02, 1, "grid of the search");
  a.field("search_step_deg", search_step_deg, "deg", 0.2, 30, "grid of the search");
}

struct BoxMapAligner::NormalEquations {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();  // of (x, y, yaw about the base centre)
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double lever_squared = 0.0;  // weighted sum, metres squared
  double weight = 0.0;
  double inlier_squared = 0.0;
  int inliers = 0;

  [[nodiscard]] double lever_m() const {
    return weight > 0.0 ? std::max(0.5, std::sqrt(lever_squared / weight)) : 1.0;
  }
};

BoxMapAligner::BoxMapAligner(Config config, const ArenaMap& arena)
    : config_(config), segments_(wallSegments(arena.walls)) {}

/// First point of each occupied cell: walls near the sensor do not outvote far ones, and no point
/// is moved.
Result<BoxMapAligner::Points> BoxMapAligner::thin(const PointCloud& scan_base) const {
  const auto half = static_cast<std::int64_t>(std::ceil(config_.max_range_m / config_.voxel_m));
  const std::int64_t width = 2 * half;
  const auto layers =
      static_cast<std::int64_t>(std::ceil((config_.z_max_m - config_.z_min_m) / 0.5)) + 1;
  std::vector<bool> taken(static_cast<std::size_t>(width * width * layers), false);
  Points kept;
  for (std::size_t i = 0; i < scan_base.size(); ++i) {
    const Eigen::Vector3d p(scan_base.x[i], scan_base.y[i], scan_base.z[i]);
    if (!(p.z() >= config_.z_min_m && p.z() <= config_.z_max_m)) continue;  // NaN fails too
    if (!(p.head<2>().squaredNorm() < config_.max_range_m * config_.max_range_m)) continue;
    const auto ix = static_cast<std::int64_t>(std::floor(p.x() / config_.voxel_m)) + half;
    const auto iy = static_cast<std::int64_t>(std::floor(p.y() / config_.voxel_m)) + half;
    const auto iz = static_cast<std::int64_t>((p.z() - config_.z_min_m) / 0.5);
    const auto cell = static_cast<std::size_t>((iz * width + iy) * width + ix);
    if (taken[cell]) continue;
    taken[cell] = true;
    kept.push_back(p);
  }
  if (kept.size() < static_cast<std::size_t>(config_.min_points)) {
    return makeError(ErrorCode::Degenerate,
                     "only {} LiDAR points between {} and {} m height; {} are needed", kept.size(),
                     config_.z_min_m, config_.z_max_m, config_.min_points);
  }
  const auto limit = static_cast<std::size_t>(config_.max_points);
  if (kept.size() <= limit) return kept;
  Points thinned(limit);
  for (std::size_t i = 0; i < limit; ++i) thinned[i] = kept[i * kept.size() / limit];
  return thinned;
}

BoxMapAligner::NormalEquations BoxMapAligner::linearise(const Points& points,
                                                        const std::vector<WallSegment>& visible,
                                                        const Pose2& X_map_base,
                                                        double gate_m) const {
  NormalEquations out;
  const double c = std::cos(X_map_base.yaw_rad), s = std::sin(X_map_base.yaw_rad);
  const double kernel = gate_m / 3.0;
  for (const Eigen::Vector3d& p_base : points) {
    const Eigen::Vector2d p = rotate(c, s, p_base);
    WallMatch match;
    if (!nearestWall(visible, {p.x() + X_map_base.x_m, p.y() + X_map_base.y_m, p_base.z()}, gate_m,
                     match))
      continue;
    const double ratio = match.distance_m / kernel;
    const double weight = 1.0 / (1.0 + ratio * ratio);
    const Eigen::Vector3d J(match.direction.x(), match.direction.y(),
                            -match.direction.x() * p.y() + match.direction.y() * p.x());
    out.H.noalias() += weight * J * J.transpose();
    out.g.noalias() += weight * match.distance_m * J;
    out.lever_squared += weight * J.z() * J.z();
    out.weight += weight;
    if (std::abs(match.distance_m) <= config_.inlier_distance_m) {
      ++out.inliers;
      out.inlier_squared += match.distance_m * match.distance_m;
    }
  }
  return out;
}

namespace {

/// H with yaw scaled to metres, so that its eigenvalues count effective points along a direction.
struct Directions {
  Eigen::Vector3d scale;
  Eigen::Matrix3d vectors;
  Eigen::Vector3d values;
};

Directions directionsOf(const Eigen::Matrix3d& H, double lever_m) {
  Directions d;
  d.scale = {1.0, 1.0, 1.0 / lever_m};
  const Eigen::Matrix3d scaled = d.scale.asDiagonal() * H * d.scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scaled);
  d.vectors = solver.eigenvectors();
  d.values = solver.eigenvalues();
  return d;
}

}  // namespace

Alignment BoxMapAligner::refine(const Points& points, const Eigen::Vector3d& p_base_sensor,
                                const Pose2& start, double first_gate_m) const {
  Alignment out;
  out.X_map_base = start;
  out.points = static_cast<int>(points.size());
  NormalEquations equations;
  Directions directions;
  for (int stage = 0; stage < kStages; ++stage) {
    const double gate =
        first_gate_m * std::pow(config_.fine_gate_m / first_gate_m, stage / (kStages - 1.0));
    const std::vector<WallSegment> visible =
        facing(segments_, transform(out.X_map_base, p_base_sensor));
    for (int i = 0; i < config_.max_iterations / kStages; ++i) {
      equations = linearise(points, visible, out.X_map_base, gate);
      directions = directionsOf(equations.H, equations.lever_m());
      const Eigen::Vector3d rhs =
          directions.vectors.transpose() * (directions.scale.asDiagonal() * equations.g);
      Eigen::Vector3d step = Eigen::Vector3d::Zero();
      for (int k = 0; k < 3; ++k) {
        if (directions.values[k] >= config_.min_information)
          step[k] = -rhs[k] / directions.values[k];
      }
      const Eigen::Vector3d delta = directions.scale.asDiagonal() * (directions.vectors * step);
      out.X_map_base.x_m += delta.x();
      out.X_map_base.y_m += delta.y();
      out.X_map_base.yaw_rad = wrapAngle(out.X_map_base.yaw_rad + delta.z());
      ++out.iterations;
      if (step.norm() < 2e-4) break;
    }
  }
  out.inlier_fraction = static_cast<double>(equations.inliers) / static_cast<double>(points.size());
  out.rms_m = equations.inliers > 0 ? std::sqrt(equations.inlier_squared / equations.inliers) : 0.0;
  Eigen::Vector3d variance;
  for (int k = 0; k < 3; ++k) {
    const bool observable = directions.values[k] >= config_.min_information;
    out.observable_directions += observable ? 1 : 0;
    variance[k] = observable
                      ? config_.residual_sigma_m * config_.residual_sigma_m / directions.values[k]
                      : kUnobservable_m * kUnobservable_m;
  }
  const Eigen::Matrix3d scaled =
      directions.vectors * variance.asDiagonal() * directions.vectors.transpose();
  out.covariance = directions.scale.asDiagonal() * scaled * directions.scale.asDiagonal();
  const double floor_yaw = config_.floor_sigma_deg * kDeg;
  out.covariance.diagonal() +=
      Eigen::Vector3d(config_.floor_sigma_m * config_.floor_sigma_m,
                      config_.floor_sigma_m * config_.floor_sigma_m, floor_yaw * floor_yaw);
  return out;
}

Result<Alignment> BoxMapAligner::judged(Alignment alignment, Stamp stamp) const {
  alignment.stamp = stamp;
  if (alignment.inlier_fraction < config_.min_inlier_fraction) {
    return makeError(ErrorCode::Degenerate,
                     "only {:.0f} % of the LiDAR points lie on known walls; {:.0f} % are needed",
                     100.0 * alignment.inlier_fraction, 100.0 * config_.min_inlier_fraction);
  }
  if (alignment.observable_directions == 0) {
    return makeError(ErrorCode::Degenerate, "the walls in view hold no direction");
  }
  return alignment;
}

Result<Alignment> BoxMapAligner::align(const PointCloud& scan_base,
                                       const Eigen::Vector3d& p_base_sensor,
                                       const Pose2& X_map_base_prior) const {
  if (!finite(X_map_base_prior))
    return makeError(ErrorCode::InvalidInput, "the pose prior is not finite");
  const auto points = thin(scan_base);
  if (!points) return tl::make_unexpected(points.error());
  return judged(refine(*points, p_base_sensor, X_map_base_prior, config_.track_gate_m),
                scan_base.stamp);
}

double BoxMapAligner::score(const Points& points, std::size_t stride,
                            const Eigen::Vector3d& p_base_sensor, const Pose2& X_map_base) const {
  const std::vector<WallSegment> visible = facing(segments_, transform(X_map_base, p_base_sensor));
  const double c = std::cos(X_map_base.yaw_rad), s = std::sin(X_map_base.yaw_rad);
  const double kernel = 0.5 * config_.search_step_m;
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector2d p = rotate(c, s, points[i]);
    WallMatch match;
    if (!nearestWall(visible, {p.x() + X_map_base.x_m, p.y() + X_map_base.y_m, points[i].z()},
                     3.0 * kernel, match)) {
      continue;
    }
    const double ratio = match.distance_m / kernel;
    sum += 1.0 / (1.0 + ratio * ratio);
  }
  return sum;
}

std::vector<Pose2> BoxMapAligner::candidates(const Points& points,
                                             const Eigen::Vector3d& p_base_sensor,
                                             const Pose2& prior) const {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSearchPoints);
  const int n = static_cast<int>(std::ceil(config_.search_radius_m / config_.search_step_m));
  const int m = static_cast<int>(std::ceil(config_.search_angle_deg / config_.search_step_deg));
  std::vector<std::pair<double, Pose2>> scored;
  for (int iyaw = -m; iyaw <= m; ++iyaw) {
    for (int ix = -n; ix <= n; ++ix) {
      for (int iy = -n; iy <= n; ++iy) {
        const Pose2 X{prior.x_m + ix * config_.search_step_m,
                      prior.y_m + iy * config_.search_step_m,
                      wrapAngle(prior.yaw_rad + iyaw * config_.search_step_deg * kDeg)};
        scored.emplace_back(score(points, stride, p_base_sensor, X), X);
      }
    }
  }
  const std::size_t keep = std::min(kRefinedCandidates, scored.size());
  std::partial_sort(scored.begin(), scored.begin() + static_cast<std::ptrdiff_t>(keep),
                    scored.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Pose2> out{prior};
  for (std::size_t i = 0; i < keep; ++i) out.push_back(scored[i].second);
  return out;
}

Result<Alignment> BoxMapAligner::search(const PointCloud& scan_base,
                                        const Eigen::Vector3d& p_base_sensor,
                                        const Pose2& X_map_base_prior) const {
  if (!finite(X_map_base_prior))
    return makeError(ErrorCode::InvalidInput, "the pose prior is not finite");
  const auto points = thin(scan_base);
  if (!points) return tl::make_unexpected(points.error());
  Alignment best;
  for (const Pose2& start : candidates(*points, p_base_sensor, X_map_base_prior)) {
    const Alignment refined = refine(*points, p_base_sensor, start, config_.coarse_gate_m);
    if (refined.inlier_fraction > best.inlier_fraction) best = refined;
  }
  return judged(best, scan_base.stamp);
}

}  // namespace kiln
