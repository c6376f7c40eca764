#include "robot/control/pump_controller.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/fake_devices.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;
constexpr Duration kTick = milliseconds(20);

class PumpControllerTest : public ::testing::Test {
 protected:
  void tick() {
    clock.advanceBy(kTick);
    pumps.advance();
    controller.tick(clock.now());
  }
  void run(std::array<double, 2> duty, double seconds) {
    const Stamp end = clock.now() + fromSeconds(seconds);
    while (clock.now() < end) {
      controller.setpoint({.stamp = clock.now(), .duty = duty});
      tick();
    }
  }
  void idle(double seconds) {
    const Stamp end = clock.now() + fromSeconds(seconds);
    while (clock.now() < end) tick();
  }

  ManualClock clock{Stamp{std::chrono::seconds(10)}};
  FakePumps pumps{clock};
  StopLatch stop;
  PumpController controller{{}, pumps, stop};
};

TEST_F(PumpControllerTest, FeedsTheHeartbeatAtEveryTickAlsoWithoutSetpoints) {
  idle(1.0);
  EXPECT_EQ(pumps.writes(), 50);
  EXPECT_FALSE(controller.tracking().heartbeat_lost);
}

TEST_F(PumpControllerTest, EstimatesTheLitresOfThePumpModel) {
  run({1.0, 0.5}, 10.0);
  run({0.0, 0.0}, 1.0);
  // Against the plain pumps of the fake; the model also knows that flow falls as a tank empties
  // (here by 0.5 %).
  EXPECT_NEAR(controller.tracking().sprayed_l_est, pumps.trueLitres(),
              0.01 * pumps.trueLitres() + 0.002);
  EXPECT_NEAR(pumps.trueLitres(), 1.5 * 1.6 / 60 * 10, 0.01);
  EXPECT_NEAR(controller.tracking().tank_l_est[0] + controller.tracking().tank_l_est[1],
              10.0 - controller.tracking().sprayed_l_est, 1e-9);
}

TEST_F(PumpControllerTest, CutsAStalePumpWithin200ms) {
  run({1.0, 1.0}, 2.0);
  const Stamp last = clock.now() - kTick;
  while (controller.tracking().spraying) tick();
  EXPECT_LE(clock.now() - last, milliseconds(220));
  EXPECT_EQ(pumps.state()->duty[0], 1.0);
  tick();
  EXPECT_EQ(pumps.state()->duty[0], 0.0);
}

TEST_F(PumpControllerTest, StopCutsAtTheNextTickAndNothingRestartsByItself) {
  run({1.0, 1.0}, 1.0);
  stop.set("operator", clock.now());
  controller.setpoint({.stamp = clock.now(), .duty = {1, 1}});
  tick();
  EXPECT_FALSE(controller.tracking().spraying);
  ASSERT_TRUE(stop.clear(stop.generation()));
  idle(0.1);
  EXPECT_FALSE(controller.tracking().spraying);
}

TEST_F(PumpControllerTest, NoticesTheDryPumpAndCountsOnlyTheOther) {
  pumps.setDry(1, true);
  run({1.0, 1.0}, 0.5);
  EXPECT_FALSE(controller.tracking().no_current);  // still spinning up
  run({1.0, 1.0}, 5.5);
  EXPECT_TRUE(controller.tracking().no_current);
  EXPECT_FALSE(controller.tracking().pump_no_current[0]);
  EXPECT_TRUE(controller.tracking().pump_no_current[1]);
  EXPECT_EQ(controller.tracking().blocked, "right pump draws no current");
  EXPECT_NEAR(controller.tracking().sprayed_l_est, pumps.trueLitres(), 0.025);
  run({0.0, 0.0}, 0.2);
  EXPECT_FALSE(controller.tracking().no_current);
}

TEST_F(PumpControllerTest, ClampsDutyAndRefusesNaN) {
  run({7.0, -1.0}, 0.2);
  EXPECT_EQ(controller.tracking().duty[0], 1.0);
  EXPECT_EQ(controller.tracking().duty[1], 0.0);
  controller.setpoint({.stamp = clock.now(), .duty = {NAN, 1}});
  tick();
  EXPECT_FALSE(controller.tracking().spraying);
  EXPECT_EQ(controller.tracking().blocked, "setpoint is not a number");
}

TEST_F(PumpControllerTest, EndsTooLongARunUntilItIsSetToZero) {
  PumpController::Config config;
  config.max_run_s = 2.0;
  PumpController limited(config, pumps, stop);
  const auto feed = [&](double duty, double seconds) {
    for (int k = 0; k < seconds * 50; ++k) {
      limited.setpoint({.stamp = clock.now(), .duty = {duty, duty}});
      clock.advanceBy(kTick);
      pumps.advance();
      limited.tick(clock.now());
    }
  };
  feed(1.0, 1.9);
  EXPECT_TRUE(limited.tracking().spraying);
  feed(1.0, 2.0);
  EXPECT_FALSE(limited.tracking().spraying);
  feed(0.0, 0.1);
  feed(1.0, 0.1);
  EXPECT_TRUE(limited.tracking().spraying);
}

TEST_F(PumpControllerTest, RestoresTheEstimateAfterAResume) {
  controller.restoreEstimate(1.25, {4.2, 4.4});
  run({1.0, 1.0}, 2.0);
  EXPECT_GT(controller.tracking().sprayed_l_est, 1.3);
  EXPECT_LT(controller.tracking().tank_l_est[0], 4.2);
}

TEST_F(PumpControllerTest, DoesNotPumpWithoutThePumpBoardsReport) {
  run({1.0, 1.0}, 1.0);
  pumps.freezeState(true);
  run({1.0, 1.0}, 0.5);
  EXPECT_FALSE(controller.tracking().spraying);
  EXPECT_NE(controller.tracking().blocked.find("pump state"), std::string::npos);
}

}  // namespace
}  // namespace kiln
