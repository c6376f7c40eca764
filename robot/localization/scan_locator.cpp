#include "robot/localization/scan_locator.h"

namespace kiln {
namespace {

constexpr double kUnseen = 1.0;  ///< variance of what the walls do not say: m^2, rad^2

}  // namespace

SurfelLocator::SurfelLocator(const ScanMatcher::Config& config, const Maps& maps)
    : matchers_{ScanMatcher(config, maps[0]), ScanMatcher(config, maps[1])} {}

Result<ScanMatch> SurfelLocator::locate(const PointCloud& scan_base,
                                        const Eigen::Vector3d& p_base_lidar,
                                        const AlignmentPrior& prior) const {
  const ScanMatcher& matcher = matchers_[static_cast<std::size_t>(prior.submap)];
  return prior.search ? matcher.search(scan_base, prior.X_map_base_3d, p_base_lidar)
                      : matcher.match(scan_base, prior.X_map_base_3d, p_base_lidar);
}

Result<ScanMatch> WallLocator::locate(const PointCloud& scan_base,
                                      const Eigen::Vector3d& p_base_lidar,
                                      const AlignmentPrior& prior) const {
  const auto found = prior.search ? aligner_.search(scan_base, p_base_lidar, prior.X_map_base)
                                  : aligner_.align(scan_base, p_base_lidar, prior.X_map_base);
  if (!found) return tl::make_unexpected(found.error());
  ScanMatch match;
  match.stamp = found->stamp;
  match.X_map_base = toIsometry(found->X_map_base);
  match.covariance *= kUnseen;
  constexpr int kRows[3] = {0, 1, 5};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) match.covariance(kRows[r], kRows[c]) = found->covariance(r, c);
  }
  match.observable_directions = found->observable_directions;
  match.inlier_fraction = found->inlier_fraction;
  match.rms_m = found->rms_m;
  match.iterations = found->iterations;
  match.points = found->points;
  return match;
}

}  // namespace kiln
