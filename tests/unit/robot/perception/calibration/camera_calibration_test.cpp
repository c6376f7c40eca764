#include "robot/perception/calibration/camera_calibration.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/sim/colour_camera.h"
#include "tests/unit/robot/perception/cloud/scan_rig.h"

namespace kiln {
namespace {

/// Pictures with the head at several places, as a calibration takes them.
std::vector<RobotPicture> picturesOf(const ScanRig& rig, int count) {
  sim::ColourCamera camera(rig.config, rig.arena, rig.robot);
  sim::SceneState state;
  state.X_map_base = toIsometry({0.5, 0.2, 0.1});
  std::vector<RobotPicture> out;
  for (int i = 0; i < count; ++i) {
    state.q = RobotGeometry::radians(rig.robot.q_drive_deg);
    state.q += 0.3 * Vector6d(std::sin(3.0 * i), 0.5 * std::sin(1.9 * i), 0.5 * std::cos(2.7 * i),
                              std::cos(5.1 * i), 2.0 * std::sin(2.3 * i), 2.0 * std::cos(1.3 * i));
    out.push_back({camera.render(state), state.q});
  }
  return out;
}

TEST(CameraCalibration, FindsTheOperatorCameraFromTheRobotsOwnEdges) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const ScanRig rig(seed);
    const Eigen::Isometry3d nominal = rig.robot.X_base_operatorcamera.pose();
    const auto found = CameraCalibrator({}).calibrate(picturesOf(rig, 12), rig.robot, nominal);
    ASSERT_TRUE(found.has_value()) << found.error();
    const Eigen::Isometry3d& truth = rig.arena.robot.X_base_operatorcamera;
    const auto before = difference(truth, nominal),
               after = difference(truth, found->X_parent_sensor);
    EXPECT_LT(after.rotation_rad, 0.1 * kDeg) << "was " << before.rotation_rad / kDeg;
    EXPECT_LT(after.translation_m, 0.003) << "was " << before.translation_m;
    EXPECT_LT(found->rms_after, found->rms_before);
    EXPECT_EQ(found->views, 12);
  }
}

TEST(CameraCalibration, SaysWhatIsMissing) {
  const ScanRig rig(1);
  const Eigen::Isometry3d nominal = rig.robot.X_base_operatorcamera.pose();
  const auto pictures = picturesOf(rig, 1);
  RgbImage dark = *pictures.front().picture;
  std::fill(dark.data.begin(), dark.data.end(), std::uint8_t{7});
  const auto calibrated = [&](RgbImage picture) {
    const RobotPicture seen{std::make_shared<RgbImage>(std::move(picture)), pictures.front().q};
    return CameraCalibrator({}).calibrate({&seen, 1}, rig.robot, nominal);
  };
  const auto nothing = calibrated(dark);
  ASSERT_FALSE(nothing.has_value());
  EXPECT_NE(nothing.error().message.find("lens covered"), std::string::npos);
  EXPECT_EQ(CameraCalibrator({}).calibrate({}, rig.robot, nominal).error().code,
            ErrorCode::Degenerate);
  dark.data.resize(100);
  EXPECT_EQ(calibrated(dark).error().code, ErrorCode::InvalidInput);
  const RobotPicture none;
  EXPECT_EQ(CameraCalibrator({}).calibrate({&none, 1}, rig.robot, nominal).error().code,
            ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace kiln
