#pragma once

#include <string>
#include <vector>

#include "common/core/error.h"
#include "common/robot_model/robot_geometry.h"

namespace kiln {

/// What a calibration found of one robot, laid over its nominal geometry: written by `kiln-eval
/// calibrate`, read by `kiln-robotd --calibration FILE` or from the state folder
/// (calibration.yaml). A pose that is not in the file stays nominal.
struct RobotCalibration {
  PoseConfig X_flange_lidar, X_flange_thermal, X_flange_nozzle, X_base_operatorcamera;
  std::vector<double> lidar_range_bias_m =
      std::vector<double>(16, 0.0);  ///< measured minus true, by ring
  std::string note;                  ///< when, from what, with which residuals; for people

  /// Everything nominal.
  [[nodiscard]] static RobotCalibration of(const RobotGeometry& nominal);
  void visit(ConfigArchive& a);
  /// @return the geometry with these poses. Error: InvalidInput, naming the sensor, when one is
  /// more than 5 cm or 5 deg off its nominal pose: a file of another robot, or a failed
  /// calibration.
  [[nodiscard]] Result<RobotGeometry> applyTo(const RobotGeometry& nominal) const;
};

/// A pose as it stands in YAML.
[[nodiscard]] PoseConfig poseConfig(const Eigen::Isometry3d& X);

/// Loads a calibration file over the nominal geometry.
[[nodiscard]] Result<RobotGeometry> loadCalibrated(const std::string& path,
                                                   const RobotGeometry& nominal);

}  // namespace kiln
