#include "robot/control/base_controller.h"

#include <cmath>

#include <gtest/gtest.h>

#include "robot/safety/motion_watch.h"
#include "tests/support/fake_devices.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;
constexpr Duration kTick = milliseconds(8);

class BaseControllerTest : public ::testing::Test {
 protected:
  void tick() {
    clock.advanceBy(kTick);
    base.advance();
    controller.tick(clock.now());
    const Twist2 twist = controller.tracking().commanded;
    const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
    const double accel = (speed - last_speed) / toSeconds(kTick);
    max_accel = std::max(max_accel, accel);
    max_decel = std::max(max_decel, -accel);
    last_speed = speed;
  }
  /// Setpoints at 50 Hz for `seconds`.
  void drive(const Twist2& twist, double seconds) {
    const Stamp end = clock.now() + fromSeconds(seconds);
    for (int k = 0; clock.now() < end; ++k) {
      if (k % 3 == 0) controller.setpoint({.stamp = clock.now(), .twist = twist});
      tick();
    }
  }
  void idle(double seconds) {
    const Stamp end = clock.now() + fromSeconds(seconds);
    while (clock.now() < end) tick();
  }

  ManualClock clock{Stamp{std::chrono::seconds(10)}};
  RobotGeometry robot;
  FakeBase base{clock, robot};
  StopLatch stop;
  BaseController controller{{}, robot, base, stop};
  double last_speed = 0.0, max_accel = 0.0, max_decel = 0.0;
};

TEST_F(BaseControllerTest, DrivesTheWishWithinItsLimitsAndCountsTheWay) {
  drive({0.5, 0, 0}, 3.0);
  EXPECT_NEAR(controller.tracking().measured.vx_mps, 0.5, 1e-3);
  EXPECT_LE(max_accel, 0.8 + 1e-6);
  drive({0, 0, 0}, 2.0);
  const BaseTracking tracking = controller.tracking();
  EXPECT_TRUE(tracking.at_rest);
  EXPECT_NEAR(tracking.X_odom_base.x_m, base.truePose().x_m, 1e-3);
  EXPECT_GT(tracking.X_odom_base.x_m, 1.0);
  EXPECT_TRUE(tracking.blocked.empty()) << tracking.blocked;
}

TEST_F(BaseControllerTest, ScalesSpeedAndYawRateTogether) {
  drive({5.0, 0, 1.0}, 4.0);
  const Twist2 t = controller.tracking().commanded;
  EXPECT_NEAR(t.vx_mps, 1.0, 1e-6);
  EXPECT_NEAR(t.wz_radps, 0.2, 1e-6);
}

TEST_F(BaseControllerTest, NobodyDrivesTheFootprintOutOfTheFence) {
  const auto fence =
      Geofence::create({}, {{-3, -3}, {4, -3}, {4, 3}, {-3, 3}}, robot.length_m, robot.width_m);
  ASSERT_TRUE(fence.has_value());
  controller.setGeofence(std::make_shared<const Geofence>(*fence));
  controller.placeInMap(Pose2{0.5, 0, 0});  // odometry began half a metre ahead
  drive({1.0, 0, 0}, 8.0);
  const double nose_m = 0.5 + controller.tracking().X_odom_base.x_m + 0.5 * robot.length_m;
  EXPECT_LT(nose_m, 4.0);
  EXPECT_GT(nose_m, 4.0 - 0.35) << "it may come near";
  EXPECT_NE(controller.tracking().limited.find("geofence"), std::string::npos);
  EXPECT_TRUE(controller.tracking().blocked.empty());
  EXPECT_LE(max_decel, 1.8 + 1e-6);
  drive({-0.5, 0, 0}, 2.0);
  EXPECT_LT(controller.tracking().measured.vx_mps, -0.3) << "back is free";
  EXPECT_TRUE(controller.tracking().limited.empty()) << controller.tracking().limited;
}

TEST_F(BaseControllerTest, TurnsTheWheelsFirstAndThenDrivesSideways) {
  const std::size_t before = base.sent().size();
  drive({0, 0.5, 0}, 3.0);
  const auto sent = base.sent();
  for (std::size_t k = before; k < sent.size(); ++k) {
    for (const WheelCommand& wheel : sent[k]) {
      // 90 deg at 174 deg/s: no drive while a wheel is more than 30 deg off.
      if (std::abs(wheel.steer_rad) < 55 * M_PI / 180) {
        ASSERT_NEAR(wheel.drive_radps, 0.0, 1e-6);
      }
    }
  }
  EXPECT_NEAR(base.truePose().x_m, 0.0, 0.01);
  EXPECT_GT(base.truePose().y_m, 0.8);
  EXPECT_NEAR(base.truePose().yaw_rad, 0.0, 0.01);
}

TEST_F(BaseControllerTest, DoesNotFlipItsWheelsOnNoiseAroundZero) {
  drive({0.3, 0, 0}, 1.5);
  drive({0, 0, 0}, 1.0);
  const auto steer_before = base.sent().back();
  for (int k = 0; k < 200; ++k) {
    const double noise = (k % 2 == 0 ? 1 : -1) * 0.002;
    controller.setpoint({.stamp = clock.now(), .twist = {noise, -noise, 0}});
    tick();
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(base.sent().back()[i].steer_rad, steer_before[i].steer_rad);
  }
}

TEST_F(BaseControllerTest, RampsToZeroWithin250msOfTheLastSetpoint) {
  drive({1.0, 0, 0}, 3.0);
  ASSERT_NEAR(last_speed, 1.0, 1e-6);
  const Stamp last_setpoint = clock.now();
  controller.setpoint({.stamp = last_setpoint, .ttl = milliseconds(1000), .twist = {1.0, 0, 0}});
  while (controller.tracking().commanded.vx_mps > 1.0 - 1e-6) tick();
  EXPECT_LE(clock.now() - last_setpoint, milliseconds(250));
  EXPECT_GE(clock.now() - last_setpoint, milliseconds(200));
  EXPECT_NE(controller.tracking().blocked.find("old"), std::string::npos);
  max_decel = 0.0;
  const Stamp ramp = clock.now();
  while (controller.tracking().commanded.vx_mps > 0.0) tick();
  EXPECT_NEAR(max_decel, 1.8, 0.01);
  EXPECT_LE(toSeconds(clock.now() - ramp), 0.70);  // v / a + a / j = 0.56 + 0.09 s
}

// A daemon that is killed on its way, and one that goes on with --resume.
TEST_F(BaseControllerTest, TakesOverABaseThatStillRollsAndBringsItToRestUnblamed) {
  drive({1.0, 0, 0}, 3.0);
  BaseController next{{}, robot, base, stop};
  MotionWatch watch{{}};
  double before_mps = 1.0;
  for (int i = 0; i < 125; ++i) {
    clock.advanceBy(kTick);
    base.advance();
    next.tick(clock.now());
    const BaseTracking t = next.tracking();
    if (i == 0) EXPECT_NEAR(t.commanded.vx_mps, 1.0, 0.02) << "no jump";
    EXPECT_GE(t.measured.vx_mps, -1e-6);
    EXPECT_LE((before_mps - t.commanded.vx_mps) / toSeconds(kTick), 1.8 + 1e-6);
    before_mps = t.commanded.vx_mps;
    EXPECT_EQ(watch.step({t.stamp, t.commanded, t.measured, t.X_odom_base, std::nullopt}), "");
  }
  EXPECT_TRUE(next.tracking().at_rest);
}

TEST_F(BaseControllerTest, StopsOnTheLatchAndStaysStoppedAfterItIsCleared) {
  drive({1.0, 0, 0}, 3.0);
  stop.set("operator", clock.now());
  idle(1.0);
  EXPECT_TRUE(controller.tracking().at_rest);
  EXPECT_EQ(controller.tracking().blocked, "STOP latched by operator");
  EXPECT_FALSE(controller.tracking().ready);
  controller.setpoint({.stamp = clock.now(), .twist = {1.0, 0, 0}});
  tick();
  ASSERT_TRUE(stop.clear(stop.generation()));
  idle(0.5);
  EXPECT_EQ(controller.tracking().commanded.vx_mps, 0.0);  // what came while latched is void
  drive({0.2, 0, 0}, 1.0);
  EXPECT_GT(controller.tracking().commanded.vx_mps, 0.1);
}

TEST_F(BaseControllerTest, LeavesABaseThatMovesOnAfterStopToItsOwnWatchdog) {
  base.setSag(-0.4);  // drives off whatever is commanded
  drive({0, 0, 0}, 1.0);
  ASSERT_GT(std::abs(controller.tracking().measured.vx_mps), 0.2);
  stop.set("motion watch", clock.now());
  idle(0.5);
  const std::size_t sent = base.sent().size();
  idle(1.0);
  EXPECT_EQ(base.sent().size(), sent) << "not one setpoint more";
  EXPECT_NE(controller.tracking().blocked.find("withheld"), std::string::npos);
  ASSERT_TRUE(stop.clear(stop.generation()));
  base.setSag(0.0);
  idle(0.1);
  EXPECT_GT(base.sent().size(), sent);
}

TEST_F(BaseControllerTest, GoesOnSayingZeroToABaseThatObeysStop) {
  drive({1.0, 0, 0}, 3.0);
  stop.set("operator", clock.now());
  idle(2.0);
  const std::size_t sent = base.sent().size();
  idle(0.5);
  EXPECT_GT(base.sent().size(), sent + 50);
}

TEST_F(BaseControllerTest, StopsWhenTheWheelStateIsStale) {
  drive({1.0, 0, 0}, 3.0);
  base.freezeState(true);
  drive({1.0, 0, 0}, 1.0);
  EXPECT_EQ(controller.tracking().commanded.vx_mps, 0.0);
  EXPECT_FALSE(controller.tracking().ready);
  EXPECT_NE(controller.tracking().blocked.find("wheel state"), std::string::npos);
}

TEST_F(BaseControllerTest, RefusesNaNFutureAndReorderedSetpoints) {
  drive({0.5, 0, 0}, 1.5);
  controller.setpoint({.stamp = clock.now(), .twist = {NAN, 0, 0}});
  tick();
  EXPECT_EQ(controller.tracking().blocked, "setpoint is not a number");
  idle(1.0);
  controller.setpoint({.stamp = clock.now() + std::chrono::seconds(1), .twist = {0.5, 0, 0}});
  idle(0.2);
  EXPECT_EQ(controller.tracking().commanded.vx_mps, 0.0);
  for (const WheelCommands& c : base.sent()) {
    for (const WheelCommand& wheel : c) {
      ASSERT_TRUE(std::isfinite(wheel.drive_radps) && std::isfinite(wheel.steer_rad));
    }
  }
}

TEST_F(BaseControllerTest, AReorderedSetpointDoesNotReplaceANewerOne) {
  idle(0.1);
  controller.setpoint({.stamp = clock.now(), .twist = {0.5, 0, 0}});
  controller.setpoint({.stamp = clock.now() - milliseconds(20), .twist = {-0.5, 0, 0}});
  idle(0.1);
  EXPECT_GT(controller.tracking().commanded.vx_mps, 0.0);
}

TEST_F(BaseControllerTest, HasOneWriterAtATimeAndNamesIt) {
  drive({0.3, 0, 0}, 0.1);
  EXPECT_EQ(controller.tracking().writer, Writer::Program);
  const BaseSetpoint by_hand{.stamp = clock.now(), .twist = {0.1, 0, 0}, .writer = Writer::Hand};
  EXPECT_DEATH(controller.setpoint(by_hand), "one writer at a time");
  controller.setpoint({.stamp = clock.now(), .twist = {}});  // a rest hands over
  controller.setpoint(by_hand);
  tick();
  EXPECT_EQ(controller.tracking().writer, Writer::Hand);
  idle(0.3);
  EXPECT_EQ(controller.tracking().writer, std::nullopt) << "silence is nobody's";
  drive({0.3, 0, 0}, 0.1);
  EXPECT_EQ(controller.tracking().writer, Writer::Program);
}

TEST_F(BaseControllerTest, ReversesThroughZeroWithoutDrivingOnCrossedWheels) {
  drive({0.5, 0, 0}, 2.0);
  drive({0, -0.5, 0}, 3.0);
  drive({-0.4, 0.3, 0}, 3.0);
  EXPECT_NEAR(controller.tracking().measured.vx_mps, -0.4, 0.01);
  EXPECT_NEAR(controller.tracking().measured.vy_mps, 0.3, 0.01);
  EXPECT_NEAR(base.truePose().yaw_rad, 0.0, 0.02);
}

TEST_F(BaseControllerTest, MakesGoodWhatTheDrivesGiveAwayUnderLoadUpToItsLimit) {
  base.setSag(-0.03);
  drive({0.5, 0, 0}, 4.0);
  EXPECT_NEAR(controller.tracking().measured.vx_mps, 0.5, 2e-3);
  EXPECT_NEAR(controller.tracking().trim_mps, 0.03, 2e-3);
  EXPECT_EQ(controller.tracking().commanded.vx_mps, 0.5);
  drive({0, 0, 0}, 3.0);
  EXPECT_TRUE(controller.tracking().at_rest);
  EXPECT_NEAR(controller.tracking().measured.vx_mps, 0.0, 1e-3);  // rolls back no more
  base.setSag(-0.5);
  drive({0.5, 0, 0}, 4.0);
  EXPECT_NEAR(controller.tracking().trim_mps, 0.05, 1e-9);
}

TEST_F(BaseControllerTest, GivesNoTrimWithoutAWheelState) {
  base.setSag(-0.03);
  drive({0.5, 0, 0}, 4.0);
  base.freezeState(true);
  idle(1.5);
  EXPECT_EQ(controller.tracking().trim_mps, 0.0);
  for (const WheelCommand& wheel : base.sent().back()) EXPECT_EQ(wheel.drive_radps, 0.0);
}

TEST_F(BaseControllerTest, LeavesDrivesThatFollowAlone) {
  for (const Twist2& twist : {Twist2{0.8, 0, 0}, Twist2{0, 0, 0}, Twist2{-0.3, 0.2, 0.2}}) {
    drive(twist, 3.0);
    EXPECT_LT(controller.tracking().trim_mps, 1e-3);
  }
}

TEST_F(BaseControllerTest, OdometryCanBeReset) {
  drive({0.5, 0, 0}, 2.0);
  drive({0, 0, 0}, 2.0);
  controller.resetOdometry();
  EXPECT_EQ(controller.tracking().X_odom_base.x_m, 0.0);
  tick();
  EXPECT_NEAR(controller.tracking().X_odom_base.x_m, 0.0, 1e-6);
}

}  // namespace
}  // namespace kiln
