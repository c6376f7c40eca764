#include "robot/perception/calibration/lidar_calibration.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "tests/unit/robot/perception/cloud/scan_rig.h"

namespace kiln {
namespace {

/// The kitchen seen from the hub by a robot whose LiDAR sits where this seed has put it.
std::vector<StillScan> scansOf(ScanRig& rig, int postures, double tilt_deg) {
  std::vector<StillScan> out;
  const SelfFilter filter(rig.robot, {});
  for (int i = 0; i < postures; ++i) {
    Vector6d q = RobotGeometry::radians(rig.robot.q_drive_deg);
    q[0] += 1.2 * std::sin(2.1 * i);
    q[3] += tilt_deg * kDeg * std::sin(1.3 * i + 0.4);
    q[4] += tilt_deg * kDeg * std::sin(2.9 * i);
    q[5] += 1.0 * tilt_deg * kDeg * std::cos(1.7 * i);
    const auto still = [&](double) { return ScanRig::Motion{{9.3, 0.4, 0.1}, q}; };
    const auto scan = rig.scan(0.2 + 0.3 * i, still);
    ArmTrack arm;
    arm.push(scan->stamp, q);
    out.push_back({std::make_shared<PointCloud>(filter.filter(*scan, arm).cloud),
                   rig.robot.X_base_flange(q)});
  }
  return out;
}

TEST(LidarCalibration, FindsTheMountingFromWallsAndFloor) {
  for (const std::uint64_t seed : {1u, 2u}) {
    ScanRig rig(seed);
    const auto scans = scansOf(rig, 16, 35.0);
    const auto found = LidarCalibrator({}).calibrate(scans, rig.robot.X_flange_lidar.pose());
    ASSERT_TRUE(found.has_value()) << found.error();
    const Eigen::Isometry3d& truth = rig.arena.robot.X_flange_lidar;
    const auto before = difference(truth, rig.robot.X_flange_lidar.pose());
    const auto after = difference(truth, found->flange_lidar.X_parent_sensor);
    EXPECT_LT(after.rotation_rad, 0.06 * kDeg) << "was " << before.rotation_rad / kDeg;
    EXPECT_LT(after.translation_m, 0.004) << "was " << before.translation_m;
    EXPECT_LT(found->flange_lidar.rms_after, found->flange_lidar.rms_before);
    EXPECT_LT(found->flange_lidar.rms_after, 0.013) << "white noise of 1 cm";
    EXPECT_GT(found->patches, 50);
  }
}

TEST(LidarCalibration, SaysWhatIsMissing) {
  ScanRig rig(1);
  const Eigen::Isometry3d nominal = rig.robot.X_flange_lidar.pose();
  const LidarCalibrator calibrator{{}};
  EXPECT_NE(calibrator.calibrate(scansOf(rig, 3, 30.0), nominal).error().message.find("too few"),
            std::string::npos);
  const auto upright = calibrator.calibrate(scansOf(rig, 10, 0.0), nominal);
  ASSERT_FALSE(upright.has_value());
  EXPECT_NE(upright.error().message.find("one axis only"), std::string::npos);
  auto empty = scansOf(rig, 8, 30.0);
  for (StillScan& scan : empty) scan.scan_lidar = std::make_shared<PointCloud>();
  EXPECT_EQ(calibrator.calibrate(empty, nominal).error().code, ErrorCode::Degenerate);
}

}  // namespace
}  // namespace kiln
