#include "robot/app/teleop.h"

#include <gtest/gtest.h>

#include "robot/scene/fire_site_map.h"
#include "tests/support/fake_devices.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;

class TeleopTest : public testing::Test {
 protected:
  static RobotGeometry loadRobot() {
    RobotGeometry robot;
    EXPECT_TRUE(
        loadConfig(kiln::sourceDir() + "/resources/robot_model/bob.yaml", robot).has_value());
    return robot;
  }
  /// Control ticks of 8 ms with the fake devices in step.
  void run(Duration length) {
    const Stamp end = clock_.now() + length;
    while (clock_.now() < end) {
      clock_.advanceBy(milliseconds(8));
      arm_device_.advance();
      base_device_.advance();
      pumps_device_.advance();
      base_.tick(clock_.now());
      arm_.tick(clock_.now());
      pumps_.tick(clock_.now());
    }
  }

  RobotGeometry robot_ = loadRobot();
  ManualClock clock_;
  StopLatch stop_;
  FakeArm arm_device_{clock_, robot_, RobotGeometry::radians(robot_.q_drive_deg)};
  FakeBase base_device_{clock_, robot_};
  FakePumps pumps_device_{clock_};
  BaseController base_{{}, robot_, base_device_, stop_};
  ArmController arm_{{}, robot_, arm_device_, stop_};
  PumpController pumps_{{}, pumps_device_, stop_};
  ArenaMap arena_;  // nothing around
  Teleop teleop_{{}, robot_, arena_, base_, arm_, pumps_};
};

TEST_F(TeleopTest, SilenceIsAReleaseOfTheBase) {
  run(milliseconds(200));
  teleop_.setSpeedScale(0.5);
  for (int i = 0; i < 50; ++i) {
    teleop_.jogBase({{1.0, 0.0, 0.0}}, clock_.now(), 1.0);
    run(milliseconds(40));
  }
  EXPECT_NEAR(base_.tracking().commanded.vx_mps, 0.5, 0.01) << "full stick times the speed scale";
  run(milliseconds(250));
  const double after_ttl = base_.tracking().commanded.vx_mps;
  run(milliseconds(100));
  EXPECT_LT(base_.tracking().commanded.vx_mps, after_ttl + 1e-9);
  run(milliseconds(600));
  EXPECT_NEAR(base_.tracking().commanded.vx_mps, 0.0, 1e-3);
}

TEST_F(TeleopTest, SilenceCutsThePumps) {
  run(milliseconds(200));
  teleop_.holdActuator({kPumps, 1.0}, clock_.now());
  run(milliseconds(100));
  EXPECT_GT(pumps_.tracking().duty[0], 0.0);
  run(milliseconds(250));
  EXPECT_EQ(pumps_.tracking().duty[0], 0.0);
}

TEST_F(TeleopTest, MovesTheToolAlongTheBaseAxes) {
  run(milliseconds(200));
  teleop_.setSpeedScale(1.0);
  const Eigen::Vector3d before = robot_.X_base_flange(arm_device_.state()->q).translation();
  JogArm jog;
  jog.frame = JogFrame::Base;
  jog.velocity[2] = 0.1;  // up
  for (int i = 0; i < 25; ++i) {
    teleop_.jogArm(jog, arm_device_.state()->q, Pose2{}, clock_.now(), 1.0);
    run(milliseconds(40));
  }
  const Eigen::Vector3d moved = robot_.X_base_flange(arm_device_.state()->q).translation() - before;
  EXPECT_GT(moved.z(), 0.05);
  EXPECT_LT(std::hypot(moved.x(), moved.y()), 0.2 * moved.z()) << "straight up";
}

TEST_F(TeleopTest, StopsBeforeTheRobotsOwnDeckAndSaysSo) {
  run(milliseconds(200));
  teleop_.setSpeedScale(1.0);
  JogArm jog;
  jog.frame = JogFrame::Base;
  jog.velocity[0] = -0.15;  // back over the deck
  jog.velocity[2] = -0.25;  // and down into it
  const ArmCollision collision(robot_);
  double nearest = 1.0;
  for (int i = 0; i < 250; ++i) {
    teleop_.jogArm(jog, arm_device_.state()->q, Pose2{}, clock_.now(), 1.0);
    run(milliseconds(40));
    nearest = std::min(nearest, collision.distance(arm_device_.state()->q));
  }
  EXPECT_FALSE(teleop_.blocked().empty());
  EXPECT_GT(nearest, 0.0) << "touched";
  jog.velocity = -jog.velocity;
  teleop_.jogArm(jog, arm_device_.state()->q, Pose2{}, clock_.now(), 1.0);
  EXPECT_EQ(teleop_.blocked(), "") << "away is allowed";
}

TEST_F(TeleopTest, EachActuatorRunsWhatItIsCalled) {
  run(milliseconds(200));
  for (const ActuatorSpec& actuator : Teleop::actuators()) {
    teleop_.holdActuator({actuator.name, 1.0}, clock_.now());
    run(milliseconds(100));
    const auto duty = pumps_.tracking().duty;
    EXPECT_EQ(duty[0] > 0.0, actuator.name != kPumpRight) << actuator.name;
    EXPECT_EQ(duty[1] > 0.0, actuator.name != kPumpLeft) << actuator.name;
    run(milliseconds(400));
  }
}

TEST_F(TeleopTest, ArmJogStopsBeforeAPlaceWhereItStandsNow) {
  run(milliseconds(200));
  teleop_.setSpeedScale(1.0);
  FirePlaceConfig place;
  place.name = "place 1";
  place.plate_xyz_m = {6.0, 0.0, 1.0};
  FireSiteMap site;
  site.places = {place};
  const auto stands = [&](double x_m) {
    site.movePlace(0, {x_m, 0.0, 1.0}, M_PI);
    arena_.fixtures[kFireSite] = site.fixtures();
  };
  stands(6.0);
  JogArm jog;
  jog.frame = JogFrame::Base;
  jog.velocity[0] = 0.1;  // forward, out of its drive pose
  teleop_.jogArm(jog, arm_device_.state()->q, Pose2{}, clock_.now(), 1.0);
  EXPECT_EQ(teleop_.blocked(), "") << "far away";
  const double reach_m = robot_.X_base_flange(arm_device_.state()->q).translation().x();
  stands(reach_m + 0.25);
  teleop_.jogArm(jog, arm_device_.state()->q, Pose2{}, clock_.now(), 1.0);
  EXPECT_NE(teleop_.blocked().find("place 1"), std::string::npos) << teleop_.blocked();
  stands(6.0);
  teleop_.jogArm(jog, arm_device_.state()->q, Pose2{}, clock_.now(), 1.0);
  EXPECT_EQ(teleop_.blocked(), "") << "moved away again";
}

TEST_F(TeleopTest, ReleaseAllStopsEverythingAtOnce) {
  run(milliseconds(200));
  teleop_.holdActuator({kPumps, 1.0}, clock_.now());
  teleop_.jogBase({{1.0, 0.0, 0.0}}, clock_.now(), 1.0);
  run(milliseconds(80));
  teleop_.releaseAll(clock_.now());
  run(milliseconds(24));
  EXPECT_EQ(pumps_.tracking().duty[0], 0.0);
  run(milliseconds(800));
  EXPECT_NEAR(base_.tracking().commanded.vx_mps, 0.0, 1e-3);
}

}  // namespace
}  // namespace kiln
