#include "robot/evaluation/calibration/calibration_rig.h"

#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "common/config/resources.h"
#include "tests/support/fake_devices.h"

namespace kiln {
namespace {

/// A sensor that is there and sends nothing.
template <class Device, class Frame>
struct Silent final : Device {
  Result<void> start(Sink<Frame>) override { return {}; }
  void stop() override {}
};

struct CalibrationRigTest : ::testing::Test {
  CalibrationRigTest() {
    rig = std::make_unique<CalibrationRig>(
        CalibrationRig::Config{}, robot, CalibrationYard{},
        CalibrationDevices{arm, lidar, clock, [this] { return step(); }, &pumps, &thermal,
                           &camera});
  }
  Result<void> step() {
    clock.advanceBy(std::chrono::milliseconds(8));
    arm.advance();
    pumps.advance();
    if (broken) return makeError(ErrorCode::Unavailable, "the world is gone");
    return {};
  }
  [[nodiscard]] std::array<double, 2> duty() {
    pumps.advance();
    return pumps.state()->duty;
  }
  static constexpr std::array<double, 2> kOff{0.0, 0.0}, kFull{1.0, 1.0};

  RobotGeometry robot = *loadResource<RobotGeometry>("robot_model/bob.yaml");
  ManualClock clock;
  FakeArm arm{clock, robot, RobotGeometry::radians(robot.q_drive_deg)};
  FakePumps pumps{clock};
  Silent<Lidar, PointCloudPtr> lidar;
  Silent<ThermalCamera, ThermalImagePtr> thermal;
  Silent<RgbCamera, RgbImagePtr> camera;
  bool broken = false;
  std::unique_ptr<CalibrationRig> rig;
};

TEST_F(CalibrationRigTest, SpraysOnlyWhenToldAndNeverAfterItsEnd) {
  ASSERT_TRUE(rig->pass(0.2).has_value());
  EXPECT_EQ(duty(), kOff);
  rig->spray(true);
  ASSERT_TRUE(rig->pass(0.2).has_value());
  EXPECT_EQ(duty(), kFull);
  rig->spray(false);
  ASSERT_TRUE(rig->pass(0.1).has_value());
  EXPECT_EQ(duty(), kOff);
  rig->spray(true);
  ASSERT_TRUE(rig->pass(0.2).has_value());
  broken = true;
  EXPECT_FALSE(rig->pass(0.2).has_value());
  EXPECT_EQ(duty(), kFull) << "nobody has told the pumps yet";
  rig.reset();
  EXPECT_EQ(duty(), kOff);
}

TEST_F(CalibrationRigTest, NamesThePumpThatIsDry) {
  pumps.setDry(1, true);
  rig->spray(true);
  ASSERT_TRUE(rig->pass(1.5).has_value());
  const auto state = rig->pumps();
  ASSERT_FALSE(state.has_value());
  EXPECT_NE(state.error().message.find("right pump"), std::string::npos) << state.error();
}

TEST_F(CalibrationRigTest, SaysWhichSensorIsSilent) {
  ASSERT_TRUE(rig->startSensors().has_value());
  EXPECT_NE(rig->nextScan().error().message.find("LiDAR"), std::string::npos);
  EXPECT_NE(rig->nextImage().error().message.find("thermal"), std::string::npos);
  EXPECT_NE(rig->takePicture().error().message.find("operator camera"), std::string::npos);
}

// Every half, third, ... of the range holds its share of the numbers, however few are taken.
TEST(Spread, FillsItsRangeEvenly) {
  for (const int prime : {2, 3, 5}) {
    std::vector<double> taken;
    for (int i = 0; i + 1 < prime * prime; ++i) taken.push_back(spread(i, prime, 2.0));
    std::sort(taken.begin(), taken.end());
    for (std::size_t i = 0; i < taken.size(); ++i)
      EXPECT_NEAR(taken[i], -2.0 + 4.0 * static_cast<double>(i + 1) / (prime * prime), 1e-12);
  }
}

}  // namespace
}  // namespace kiln
