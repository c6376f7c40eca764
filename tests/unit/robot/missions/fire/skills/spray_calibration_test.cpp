#include "robot/missions/fire/skills/spray_calibration.h"

#include <fstream>

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(SprayCalibration, DefaultsAreBallistic) {
  const SprayCalibration calibration;
  ASSERT_TRUE(calibration.validate().has_value());
  // g d^2 / (2 v^2) with v = 6 m/s; linear interpolation errs by less than 2 mm.
  for (const double d : {0.1, 0.3, 0.45, 0.7, 0.9, 1.05, 1.3, 1.6})
    EXPECT_NEAR(calibration.dropAt(d), 9.81 * d * d / 72.0, 0.002) << d;
  EXPECT_NEAR(calibration.dropAt(0.9), 0.11, 0.001) << "scenario.md section 2";
}

TEST(SprayCalibration, SlowerWaterFallsWithTheSquare) {
  const SprayCalibration calibration;
  EXPECT_NEAR(calibration.dropAt(0.7, 0.8), calibration.dropAt(0.7) / 0.64, 1e-12);
  EXPECT_EQ(calibration.flowScale(1.0), 1.0);
  EXPECT_NEAR(calibration.flowScale(0.0), 0.8, 1e-12);
  EXPECT_NEAR(calibration.flowScale(-1.0), 0.8, 1e-12);
}

TEST(SprayCalibration, RefusesTablesThatDoNotFit) {
  SprayCalibration uneven;
  uneven.drop_m.pop_back();
  ASSERT_FALSE(uneven.validate().has_value());
  EXPECT_NE(uneven.validate().error().message.find("6, 5 and 6"), std::string::npos);
  SprayCalibration falling;
  falling.distance_m = {0.3, 0.5, 0.5, 0.9, 1.1, 1.3};
  EXPECT_FALSE(falling.validate().has_value());
  SprayCalibration empty;
  empty.distance_m = empty.drop_m = empty.lateral_m = {};
  EXPECT_FALSE(empty.validate().has_value());
}

TEST(SprayCalibration, AnAbsentTableIsAnErrorWithFileAndName) {
  EXPECT_TRUE(loadSprayCalibration("config/spray_calibration.yaml").has_value());
  const std::string copy = ::testing::TempDir() + "spray_calibration.yaml";
  std::ofstream(copy) << "exit_speed_mps: 6.0\n";
  const auto loaded = loadSprayCalibration(copy);
  ASSERT_FALSE(loaded.has_value());
  EXPECT_NE(loaded.error().message.find(copy + ": 'distance_m' is missing"), std::string::npos)
      << loaded.error();
}

}  // namespace
}  // namespace kiln
