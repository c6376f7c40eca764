#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "robot/sim/pump_device.h"

namespace kiln::sim {
namespace {

constexpr double kStep = 0.004;

/// Runs the pumps with a heartbeat each step; returns litres.
double run(PumpDevice& pumps, Stamp& now, double seconds, std::array<double, 2> duty) {
  double litres = 0.0;
  const Stamp end = now + fromSeconds(seconds);
  while (now < end) {
    EXPECT_EQ(pumps.write(now, duty), "");
    litres += pumps.step(now, kStep);
    now += fromSeconds(kStep);
  }
  return litres;
}

TEST(PumpDevice, DeliversItsFlowAfterSpinUp) {
  PumpDevice pumps({}, 1);
  Stamp now;
  (void)run(pumps, now, 1.0, {1, 1});
  const double litres = run(pumps, now, 6.0, {1, 1});
  // 6 s at 1.6 l/min +-10 % each, less up to 1.5 % for what has left the tanks.
  const double full = (pumps.fullFlow(0) + pumps.fullFlow(1)) / 60.0 * 6.0;
  EXPECT_NEAR(litres, full, 0.02 * full);
  for (const std::size_t i : {0u, 1u}) EXPECT_NEAR(pumps.fullFlow(i), 1.6, 0.16);
}

TEST(PumpDevice, CutsBothPumps200msAfterTheLastHeartbeat) {
  PumpDevice pumps({}, 1);
  Stamp now;
  (void)run(pumps, now, 1.0, {1, 1});
  const Stamp last = now - fromSeconds(kStep);
  while (!pumps.report(now).heartbeat_lost) {
    (void)pumps.step(now, kStep);
    now += fromSeconds(kStep);
    ASSERT_LT(toSeconds(now - last), 0.25);
  }
  EXPECT_GT(toSeconds(now - last), 0.199);
  EXPECT_EQ(pumps.report(now).duty[0], 0.0);
  (void)run(pumps, now, 0.1, {1, 0});  // a new heartbeat brings them back
  EXPECT_FALSE(pumps.report(now).heartbeat_lost);
}

TEST(PumpDevice, BlockedOrDryShowsInTheCurrentAlone) {
  WaterConfig config;
  config.tank_l = 0.05;
  PumpDevice pumps(config, 1);
  Stamp now;
  (void)run(pumps, now, 1.0, {1, 1});
  EXPECT_NEAR(pumps.report(now).current_a[0], 3.0, 0.3);
  pumps.setBlocked(0, true);
  (void)run(pumps, now, 1.0, {1, 1});
  EXPECT_LT(pumps.report(now).current_a[0], 1.0);
  const double rest = run(pumps, now, 10.0, {0, 1});
  EXPECT_LE(rest, 0.05);
  EXPECT_LT(pumps.report(now).current_a[1], 1.0);  // dry
  EXPECT_EQ(run(pumps, now, 1.0, {0, 1}), 0.0);
}

TEST(PumpDevice, RefusesDutiesThatAreNoShare) {
  PumpDevice pumps({}, 1);
  for (const double bad : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(pumps.write(Stamp{}, {bad, 0}), "");
  }
}

}  // namespace
}  // namespace kiln::sim
