#include "common/robot_model/robot_calibration.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "common/core/units.h"

namespace kiln {
namespace {

RobotGeometry bob() {
  RobotGeometry robot;
  EXPECT_TRUE(loadConfig(*resourcePath("robot_model/bob.yaml"), robot).has_value());
  return robot;
}

std::string written(const std::string& text) {
  const std::string path = testing::TempDir() + "kiln_calibration_" +
                           testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml";
  std::ofstream(path) << text;
  return path;
}

TEST(RobotCalibration, PosesSurviveTheFileAlsoWherePitchIsARightAngle) {
  const RobotGeometry nominal = bob();
  RobotCalibration calibration = RobotCalibration::of(nominal);
  const Eigen::Isometry3d off =
      makePose({0.004, -0.006, 0.003}, {0.3 * kDeg, -0.2 * kDeg, 0.4 * kDeg});
  for (PoseConfig* pose : {&calibration.X_flange_lidar, &calibration.X_flange_thermal,
                           &calibration.X_flange_nozzle, &calibration.X_base_operatorcamera})
    *pose = poseConfig(pose->pose() * off);
  calibration.lidar_range_bias_m[3] = -0.012;
  const auto loaded = loadCalibrated(written(dumpConfig(calibration)), nominal);
  ASSERT_TRUE(loaded.has_value()) << loaded.error();
  for (const auto& [was, is] :
       {std::pair{&nominal.X_flange_lidar, &loaded->X_flange_lidar},
        std::pair{&nominal.X_flange_nozzle, &loaded->X_flange_nozzle},
        std::pair{&nominal.X_base_operatorcamera, &loaded->X_base_operatorcamera}}) {
    const Eigen::Isometry3d left = (was->pose() * off).inverse() * is->pose();
    EXPECT_LT(left.translation().norm(), 1e-5);
    EXPECT_LT(rotationAngle(left), 1e-4 * kDeg);
  }
  EXPECT_EQ(loaded->lidar_range_bias_m[3], -0.012);
  EXPECT_EQ(loaded->X_flange_tool.xyz_m, nominal.X_flange_tool.xyz_m);
}

TEST(RobotCalibration, AMountingThatTheFileLeavesOutIsAnErrorByItsName) {
  const RobotGeometry nominal = bob();
  for (const char* text :
       {"{}", "X_flange_thermal: { xyz_m: [-0.055, 0.04, 0.13], rpy_deg: [0, 0, 0.2] }\n"}) {
    const auto loaded = loadCalibrated(written(text), nominal);
    ASSERT_FALSE(loaded.has_value());
    EXPECT_NE(loaded.error().message.find("'X_flange_lidar' is missing"), std::string::npos)
        << loaded.error();
  }
}

TEST(RobotCalibration, AFileOfAnotherRobotIsRefusedByName) {
  const RobotGeometry nominal = bob();
  RobotCalibration other = RobotCalibration::of(nominal);
  other.X_flange_thermal.xyz_m = {0.06, 0.04, 0.13};
  const auto far = loadCalibrated(written(dumpConfig(other)), nominal);
  ASSERT_FALSE(far.has_value());
  EXPECT_NE(far.error().message.find("the thermal camera is 120 mm"), std::string::npos)
      << far.error().message;
  other = RobotCalibration::of(nominal);
  other.X_flange_lidar.rpy_deg = {90, -80, 0};
  EXPECT_FALSE(loadCalibrated(written(dumpConfig(other)), nominal));
  EXPECT_FALSE(loadCalibrated(written("X_flange_lidr: {}\n"), nominal));
  EXPECT_FALSE(loadCalibrated("/nowhere/calibration.yaml", nominal));
}

}  // namespace
}  // namespace kiln
