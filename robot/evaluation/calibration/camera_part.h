#pragma once

#include "robot/evaluation/calibration/calibration_rig.h"
#include "robot/perception/calibration/camera_calibration.h"

namespace kiln {

/// Collects pictures of the operator camera while the arm goes through the postures of the other
/// parts, and calibrates the camera by the robot that it sees. A camera that is absent does not
/// hinder the others: its error comes at the end.
class CameraPart {
 public:
  explicit CameraPart(const CameraCalibrator::Config& config) : config_(config) {}
  /// @pre the arm is at rest.
  void look(CalibrationRig& rig);
  [[nodiscard]] Result<Extrinsics> calibrate(const RobotGeometry& nominal) const;

 private:
  CameraCalibrator::Config config_;
  Result<std::vector<RobotPicture>> pictures_{std::vector<RobotPicture>{}};
};

}  // namespace kiln
