#include "robot/perception/calibration/camera_calibration.h"

#include <gtest/gtest.h>

#include "robot/sim/colour_camera.h"
#include "tests/unit/robot/perception/cloud/scan_rig.h"

namespace kiln {
namespace {

constexpr double kDeg = M_PI / 180.0;

struct Seen {
  RgbImagePtr picture;
  Vector6d q;
};

Seen lookWith(const ScanRig& rig) {
  sim::SceneState state;
  state.X_map_base = toIsometry({0.5, 0.2, 0.1});
  state.q = RobotGeometry::radians(rig.robot.q_park_deg);
  return {sim::ColourCamera(rig.config, rig.arena, rig.robot).render(state), state.q};
}

TEST(CameraCalibration, FindsTheOperatorCameraFromTheRobotsOwnEdges) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const ScanRig rig(seed);
    const Seen seen = lookWith(rig);
    const Eigen::Isometry3d nominal = rig.robot.X_base_operatorcamera.pose();
    const auto found = CameraCalibrator({}).calibrate(*seen.picture, rig.robot, seen.q, nominal);
    ASSERT_TRUE(found.has_value()) << found.error();
    const Eigen::Isometry3d& truth = rig.arena.robot.X_base_operatorcamera;
    const auto before = difference(truth, nominal),
               after = difference(truth, found->X_parent_sensor);
    EXPECT_LT(after.rotation_rad, 0.2 * kDeg) << "was " << before.rotation_rad / kDeg;
    EXPECT_LT(after.translation_m, 0.008) << "was " << before.translation_m;
    EXPECT_LT(found->rms_after, found->rms_before);
  }
}

TEST(CameraCalibration, SaysWhatIsMissing) {
  const ScanRig rig(1);
  Seen seen = lookWith(rig);
  const Eigen::Isometry3d nominal = rig.robot.X_base_operatorcamera.pose();
  RgbImage dark = *seen.picture;
  std::fill(dark.data.begin(), dark.data.end(), std::uint8_t{7});
  const auto nothing = CameraCalibrator({}).calibrate(dark, rig.robot, seen.q, nominal);
  ASSERT_FALSE(nothing.has_value());
  EXPECT_NE(nothing.error().message.find("lens covered"), std::string::npos);
  dark.data.resize(100);
  EXPECT_EQ(CameraCalibrator({}).calibrate(dark, rig.robot, seen.q, nominal).error().code,
            ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace kiln
