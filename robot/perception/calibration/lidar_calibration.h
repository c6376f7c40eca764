#pragma once

#include <array>
#include <span>

#include "common/config/config_archive.h"
#include "common/model/sensor.h"
#include "robot/perception/calibration/extrinsics.h"

namespace kiln {

/// One scan taken while arm and base stood still.
struct StillScan {
  PointCloudPtr scan_lidar;  ///< in `lidar`, without the robot itself
  Eigen::Isometry3d X_base_flange = Eigen::Isometry3d::Identity();  ///< by the joints
};

struct LidarCalibration {
  Extrinsics flange_lidar;
  std::array<double, 16> range_bias_m{};  ///< by ring: measured minus true range
  int patches = 0;                        ///< flat pieces of the surroundings that were used
};

/// Mounting pose of the LiDAR and range bias of each laser from scans of still surroundings, seen
/// from many arm postures: every flat piece of wall, floor or furniture must be one plane, whatever
/// posture it was seen from. Planes are found anew in each round and are unknowns themselves;
/// solved by Ceres with the planes eliminated (Schur). Observable when the flange was turned about
/// at least two axes and planes of three directions were seen; the common part of the range biases
/// is held by its prior alone where every plane is seen face on.
class LidarCalibrator {
 public:
  struct Config {
    double cell_m = 0.4;  ///< in which a flat piece is looked for
    double max_range_m = 8.0;
    double thin_m = 0.10;   ///< a point a cube and scan
    double flat_m = 0.022;  ///< rms of a piece that counts as flat; three times that at first
    double wide_m = 0.08;   ///< its extent along both axes, rms
    int min_points = 24;
    int min_postures = 4;  ///< from which a piece must have been seen
    int rounds = 5;
    double noise_m = 0.012;       ///< one sigma of a range
    double bias_sigma_m = 0.010;  ///< prior of a laser's range bias (data sheet: 3 cm typical)
    double prior_m = 0.03, prior_deg = 2.0;  ///< of the mounting: as it was drawn
    void visit(ConfigArchive& a);
  };
  explicit LidarCalibrator(Config config) : config_(config) {}
  /// @return Error{Degenerate} with what is missing: too few postures, too little turned, too few
  /// planes or not in three directions.
  [[nodiscard]] Result<LidarCalibration> calibrate(std::span<const StillScan> scans,
                                                   const Eigen::Isometry3d& X_flange_lidar) const;

 private:
  Config config_;
};

}  // namespace kiln
