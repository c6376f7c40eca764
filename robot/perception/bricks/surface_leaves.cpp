#include "robot/perception/bricks/surface_leaves.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "common/core/check.h"
#include "common/core/units.h"
#include "robot/perception/cloud/leaf_table.h"
#include "robot/perception/cloud/plane_search.h"

namespace kiln {
namespace {

constexpr int kHalfExtent = 1 << 20;  // leaves each side of the origin: 21 bits an axis
constexpr int kTrials = 120;
constexpr std::size_t kTrialPoints = 1500;
constexpr int kRefinements = 4;
constexpr double kMaxThickness = 0.35;  // of a plane's smallest spread over its middle one

struct Leaf {
  int x, y, z;
  Leaf(const Eigen::Vector3f& p, float per_m)
      : x(static_cast<int>(std::floor(p.x() * per_m))),
        y(static_cast<int>(std::floor(p.y() * per_m))),
        z(static_cast<int>(std::floor(p.z() * per_m))) {}
  [[nodiscard]] bool inside() const {
    return std::abs(x) < kHalfExtent && std::abs(y) < kHalfExtent && std::abs(z) < kHalfExtent;
  }
  [[nodiscard]] std::uint64_t key(int dx = 0, int dy = 0, int dz = 0) const {
    const auto bits = [](int leaf) { return static_cast<std::uint64_t>(leaf + kHalfExtent); };
    return bits(x + dx) << 42 | bits(y + dy) << 21 | bits(z + dz);
  }
};

/// Weighted moments of leaves about a fixed point.
struct Moments {
  float weight = 0.0F;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
  void add(const Eigen::Vector3f& d, float w) {
    weight += w;
    sum += w * d;
    squares += w * d * d.transpose();
  }
  [[nodiscard]] Eigen::Matrix3f covariance() const {
    const Eigen::Vector3f mean = sum / weight;
    return squares / weight - mean * mean.transpose();
  }
};

}  // namespace

std::vector<SurfacePoint> thin(const std::vector<Eigen::Vector3f>& points, double leaf_m) {
  KILN_CHECK(leaf_m > 0, leaf_m);
  const float per_m = static_cast<float>(1.0 / leaf_m);
  LeafTable table(points.size());
  std::vector<SurfacePoint> out;
  for (const Eigen::Vector3f& p : points) {
    const Leaf leaf(p, per_m);
    if (!leaf.inside()) continue;
    const std::uint32_t index = table.find(leaf.key(), static_cast<std::uint32_t>(out.size()));
    if (index == out.size()) out.emplace_back();
    SurfacePoint& mean = out[index];
    mean.count += 1.0F;
    mean.p += (p - mean.p) / mean.count;
  }
  return out;
}

void estimateNormals(std::vector<SurfacePoint>& surface, double leaf_m, double radius_m,
                     const Eigen::Vector3f& sensor) {
  const float per_m = static_cast<float>(1.0 / leaf_m);
  const int reach = static_cast<int>(std::ceil(radius_m / leaf_m));
  const float square = static_cast<float>(radius_m * radius_m);
  LeafTable table(surface.size());
  for (std::size_t i = 0; i < surface.size(); ++i)
    table.find(Leaf(surface[i].p, per_m).key(), static_cast<std::uint32_t>(i));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  for (SurfacePoint& point : surface) {
    const Leaf leaf(point.p, per_m);
    Moments around;
    int leaves = 0;
    for (int dx = -reach; dx <= reach; ++dx)
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dz = -reach; dz <= reach; ++dz) {
          const std::uint32_t index = table.get(leaf.key(dx, dy, dz));
          if (index == LeafTable::kNone) continue;
          const Eigen::Vector3f d = surface[index].p - point.p;
          if (d.squaredNorm() > square) continue;
          around.add(d, surface[index].count);
          ++leaves;
        }
    point.n.setZero();
    if (leaves < 6) continue;
    solver.computeDirect(around.covariance());
    const Eigen::Vector3f spread = solver.eigenvalues();
    if (!(spread[1] > 0.0F) ||
        spread[0] > static_cast<float>(kMaxThickness * kMaxThickness) * 4.0F * spread[1])
      continue;
    point.n = solver.eigenvectors().col(0);
    if (point.n.dot(sensor - point.p) < 0.0F) point.n = -point.n;
  }
}

namespace {

std::vector<Eigen::Vector3d> lowOnes(const std::vector<SurfacePoint>& leaves,
                                     const SweepPreparation& config) {
  std::vector<Eigen::Vector3d> low;
  for (const SurfacePoint& leaf : leaves)
    if (std::abs(leaf.p.z()) < config.ground_height_m + config.ground_tolerance_m)
      low.push_back(leaf.p.cast<double>());
  return low;
}

}  // namespace

Result<GroundFit> fitGround(const std::vector<SurfacePoint>& leaves,
                            const SweepPreparation& config) {
  const std::vector<Eigen::Vector3d> low = lowOnes(leaves, config);
  if (static_cast<int>(low.size()) < config.min_ground_points)
    return makeError(ErrorCode::Degenerate,
                     "no ground around the target: {} leaves near z = 0 of the base, {} needed",
                     low.size(), config.min_ground_points);
  PlaneSearch search;
  search.within_rad = config.ground_slope_deg * kDeg;
  search.tolerance_m = config.ground_tolerance_m;
  search.trials = kTrials;
  search.most_voters = kTrialPoints;
  SupportedPlane plane = searchPlane(low, search).value_or(SupportedPlane{});
  GroundFit fit;
  for (int k = 0; k < kRefinements; ++k) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    fit.points = 0;
    double sum = 0.0;
    for (const Eigen::Vector3d& p : low) {
      const double off = plane.n.dot(p) - plane.d_m;
      if (std::abs(off) > config.ground_tolerance_m) continue;
      ++fit.points;
      sum += off * off;
      mean += p;
      squares += p * p.transpose();
    }
    if (fit.points < config.min_ground_points) break;
    mean /= fit.points;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / fit.points -
                                                                mean * mean.transpose());
    plane.n = solver.eigenvectors().col(0) * (solver.eigenvectors()(2, 0) < 0.0 ? -1.0 : 1.0);
    plane.d_m = plane.n.dot(mean);
    fit.rms_m = std::sqrt(sum / fit.points);
  }
  if (fit.points < config.min_ground_points ||
      plane.n.z() < std::cos(config.ground_slope_deg * kDeg))
    return makeError(ErrorCode::Degenerate,
                     "no ground around the target: the best plane has {} leaves ({} needed) and "
                     "leans by {:.1f} deg ({:.1f} allowed)",
                     fit.points, config.min_ground_points,
                     std::acos(std::min(1.0, plane.n.z())) / kDeg, config.ground_slope_deg);
  fit.n = plane.n;
  fit.d_m = plane.d_m;
  return fit;
}

}  // namespace kiln
