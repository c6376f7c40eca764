#include "robot/evaluation/calibration/camera_part.h"

#include <utility>

namespace kiln {

void CameraPart::look(CalibrationRig& rig) {
  if (!pictures_) return;
  auto picture = rig.takePicture();
  const auto q = rig.joints();
  if (!picture || !q) {
    pictures_ = tl::make_unexpected(picture ? q.error() : picture.error());
    return;
  }
  pictures_->push_back({std::move(*picture), *q});
}

Result<Extrinsics> CameraPart::calibrate(const RobotGeometry& nominal) const {
  if (!pictures_) return tl::make_unexpected(pictures_.error());
  return CameraCalibrator(config_).calibrate(*pictures_, nominal,
                                             nominal.X_base_operatorcamera.pose());
}

}  // namespace kiln
