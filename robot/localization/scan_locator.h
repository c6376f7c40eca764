#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "robot/localization/box_map_aligner.h"
#include "robot/localization/pose_tracker.h"
#include "robot/localization/scan_matcher.h"

namespace kiln {

/// Says where the base was when a scan was taken. Const calls from several threads are safe.
class ScanLocator {
 public:
  virtual ~ScanLocator() = default;
  /// @param scan_base     undistorted, self-filtered, in `base` at scan.stamp.
  /// @param p_base_lidar  metres: which side of a wall is seen.
  /// @return Error{Degenerate} if the scan says too little or contradicts the map.
  [[nodiscard]] virtual Result<ScanMatch> locate(const PointCloud& scan_base,
                                                 const Eigen::Vector3d& p_base_lidar,
                                                 const AlignmentPrior& prior) const = 0;
};

/// Against the surfel map of the building: outdoor or indoor, as the prior says.
class SurfelLocator : public ScanLocator {
 public:
  using Maps = std::array<std::shared_ptr<const SurfelMap>, 2>;  ///< by Submap
  SurfelLocator(const ScanMatcher::Config& config, const Maps& maps);
  [[nodiscard]] Result<ScanMatch> locate(const PointCloud& scan_base,
                                         const Eigen::Vector3d& p_base_lidar,
                                         const AlignmentPrior& prior) const override;

 private:
  std::array<ScanMatcher, 2> matchers_;
};

/// Against the nominal walls of the arena, on a level floor: where no map has been made yet.
class WallLocator : public ScanLocator {
 public:
  WallLocator(const BoxMapAligner::Config& config, const ArenaMap& arena)
      : aligner_(config, arena) {}
  [[nodiscard]] Result<ScanMatch> locate(const PointCloud& scan_base,
                                         const Eigen::Vector3d& p_base_lidar,
                                         const AlignmentPrior& prior) const override;

 private:
  BoxMapAligner aligner_;
};

}  // namespace kiln
