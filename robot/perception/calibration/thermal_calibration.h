#pragma once

#include <span>

#include "common/config/config_archive.h"
#include "robot/perception/calibration/extrinsics.h"
#include "robot/perception/thermal/plate_view.h"

namespace kiln {

/// The hot plate in one thermal image that was taken while arm and base stood still.
struct PlateSighting {
  Eigen::Isometry3d X_base_flange = Eigen::Isometry3d::Identity();  ///< by the joints
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();              ///< of its visible part
};

struct ThermalCalibration {
  Extrinsics flange_thermal;
  Eigen::Vector3d p_base_plate = Eigen::Vector3d::Zero();  ///< found beside it
};

/// Mounting pose of the thermal camera from one hot plate that stands still somewhere before the
/// robot, seen from many arm postures: one point, seen by a camera that turns about it and about
/// its own axis, fixes camera and point together (reprojection, Ceres). The part of the plate that
/// the opening hides from aslant is modelled.
class ThermalCalibrator {
 public:
  struct Config {
    thermal::PlateModel plate;
    double hfov_deg = 57.0;
    double noise_px = 0.06;
    double prior_m = 0.03, prior_deg = 2.0;  ///< of the mounting: as it was drawn
    double plate_prior_m = 0.5;              ///< of where the plate is thought to be
    double yaw_prior_deg = 10.0;             ///< of where it looks
    int min_sightings = 12;
    void visit(ConfigArchive& a);
  };
  explicit ThermalCalibrator(Config config) : config_(config) {}
  /// @param p_base_plate, normal_base  where the plate is thought to be, and its outward direction.
  [[nodiscard]] Result<ThermalCalibration> calibrate(std::span<const PlateSighting> sightings,
                                                     const Eigen::Isometry3d& X_flange_thermal,
                                                     const Eigen::Vector3d& p_base_plate,
                                                     const Eigen::Vector3d& normal_base) const;

 private:
  Config config_;
};

}  // namespace kiln
