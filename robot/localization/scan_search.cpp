#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/localization/scan_matcher.h"

namespace kiln {
namespace {

constexpr double kSamePlace_m = 0.15, kSamePlace_rad = 2.5 * kDeg;
constexpr double kOtherPlace_m = 0.30, kOtherPlace_rad = 5.0 * kDeg;

bool within(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double metres, double radians) {
  const Eigen::Isometry3d difference = a.inverse() * b;
  return difference.translation().norm() < metres && rotationAngle(difference) < radians;
}

/// The prior, moved over the ground and turned about the base's vertical.
Eigen::Isometry3d shifted(const Eigen::Isometry3d& prior, double x, double y, double yaw) {
  Eigen::Isometry3d out = prior;
  out.linear() =
      Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() * prior.linear();
  out.translation() += Eigen::Vector3d(x, y, 0.0);
  return out;
}

}  // namespace

ScanMatcher::Scan ScanMatcher::Scan::thinned(int max_patches) const {
  const auto limit = std::min(patches.size(), static_cast<std::size_t>(max_patches));
  Scan out{{}, edges};
  for (std::size_t i = 0; i < limit; ++i)
    out.patches.push_back(patches[i * patches.size() / limit]);
  return out;
}

double ScanMatcher::score(std::span<const ScanSurfel> patches,
                          const Eigen::Isometry3d& X_map_base) const {
  const int level = std::min(2, map_->config().levels - 1);
  const auto spread = static_cast<float>(0.6 * config_.search_step_m);
  const Eigen::Matrix3f R = X_map_base.linear().cast<float>();
  const Eigen::Vector3f t = X_map_base.translation().cast<float>();
  double sum = 0.0;
  SurfelMap::Neighbours near;
  for (const ScanSurfel& patch : patches) {
    const Eigen::Vector3f q = R * patch.mean + t;
    map_->gather(level, q, R * patch.view, near);
    float best = 0.0F;
    for (int j = 0; j < near.size; ++j) {
      const Surfel& surfel = *near.surfels[static_cast<std::size_t>(j)];
      if (surfel.normal.z() > 0.8F) continue;  // floor: everywhere
      const float ratio = surfel.normal.dot(q - surfel.mean) / spread;
      best = std::max(best, 1.0F / (1.0F + ratio * ratio));
    }
    sum += static_cast<double>(best);
  }
  return sum;
}

std::vector<Eigen::Isometry3d> ScanMatcher::candidates(std::span<const ScanSurfel> patches,
                                                       const Eigen::Isometry3d& prior) const {
  const int n = static_cast<int>(std::ceil(config_.search_radius_m / config_.search_step_m));
  const int m = static_cast<int>(std::ceil(config_.search_angle_deg / config_.search_step_deg));
  std::vector<std::pair<double, Eigen::Isometry3d>> scored;
  for (int iyaw = -m; iyaw <= m; ++iyaw) {
    for (int ix = -n; ix <= n; ++ix) {
      for (int iy = -n; iy <= n; ++iy) {
        const Eigen::Isometry3d X =
            shifted(prior, ix * config_.search_step_m, iy * config_.search_step_m,
                    iyaw * config_.search_step_deg * kDeg);
        scored.emplace_back(score(patches, X), X);
      }
    }
  }
  std::stable_sort(scored.begin(), scored.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Eigen::Isometry3d> out{prior};
  for (const auto& [value, X] : scored) {
    if (static_cast<int>(out.size()) > config_.search_candidates) break;
    const bool known = std::any_of(out.begin() + 1, out.end(), [&X = X](const auto& other) {
      return within(X, other, 0.35, 4.0 * kDeg);
    });
    if (!known) out.push_back(X);
  }
  return out;
}

Result<ScanMatch> ScanMatcher::search(const PointCloud& scan_base,
                                      const Eigen::Isometry3d& X_map_base_prior,
                                      const Eigen::Vector3d& p_base_sensor) const {
  const auto scan = prepare(scan_base, X_map_base_prior, p_base_sensor);
  if (!scan) return tl::make_unexpected(scan.error());
  const int coarse = std::min(2, map_->config().levels - 1), middle = std::min(1, coarse);
  const std::array<Stage, 3> rough{{{coarse, 0.25, 6}, {coarse, 0.10, 5}, {middle, 0.05, 5}}};
  const std::array<Stage, 2> fine{{{middle, 0.05, 4}, {0, 0.02, 10}}};
  const Scan few = scan->thinned(config_.search_patches);
  const Scan some = scan->thinned(2 * config_.search_patches);
  std::vector<ScanMatch> found;
  for (const Eigen::Isometry3d& start : candidates(few.patches, X_map_base_prior)) {
    const ScanMatch rough_match = refine(some, start, rough);
    const bool known = std::any_of(found.begin(), found.end(), [&](const ScanMatch& other) {
      return within(rough_match.X_map_base, other.X_map_base, kSamePlace_m, kSamePlace_rad);
    });
    if (!known) found.push_back(rough_match);
  }
  const auto better = [](const ScanMatch& a, const ScanMatch& b) {
    return a.inlier_fraction > b.inlier_fraction;
  };
  std::stable_sort(found.begin(), found.end(), better);
  if (found.size() > 4) found.resize(4);
  for (ScanMatch& match : found) match = refine(*scan, match.X_map_base, fine);
  std::stable_sort(found.begin(), found.end(), better);
  for (std::size_t i = 1; i < found.size(); ++i) {
    if (within(found[0].X_map_base, found[i].X_map_base, kOtherPlace_m, kOtherPlace_rad)) continue;
    if (found[i].inlier_fraction > config_.ambiguity_margin * found[0].inlier_fraction) {
      const Eigen::Vector3d a = found[0].X_map_base.translation(),
                            b = found[i].X_map_base.translation();
      return makeError(ErrorCode::Degenerate,
                       "two places look alike: ({:.1f}, {:.1f}) m and ({:.1f}, {:.1f}) m; set the "
                       "pose by hand or move on",
                       a.x(), a.y(), b.x(), b.y());
    }
  }
  return judged(found.front(), scan_base.stamp);
}

}  // namespace kiln
