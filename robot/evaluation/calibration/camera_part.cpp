#include "robot/evaluation/calibration/camera_part.h"

namespace kiln {

Result<Extrinsics> calibrateOperatorCamera(CalibrationRig& rig,
                                           const CameraCalibrator::Config& config) {
  const auto picture = rig.takePicture();
  if (!picture) return tl::make_unexpected(picture.error());
  const auto q = rig.joints();
  if (!q) return tl::make_unexpected(q.error());
  return CameraCalibrator(config).calibrate(**picture, rig.nominal(), *q,
                                            rig.nominal().X_base_operatorcamera.pose());
}

}  // namespace kiln
