#include "common/transport/clock_sync.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

/// A robot whose clock runs `drift` fast and stands `offset_s` ahead, behind a link with random
/// delays.
struct Exchanges {
  double offset_s = 2.7;
  double drift = 20e-6;
  std::mt19937_64 random{5};

  double robotTime(double station_s) const { return station_s + offset_s + drift * station_s; }
  void run(ClockSync& sync, double from_s, double to_s, double base_s, double jitter_s) {
    std::exponential_distribution<double> jitter(1.0 / jitter_s);
    for (double t = from_s; t < to_s; t += 0.2) {
      const double up = base_s + jitter(random);
      const double down = base_s + jitter(random);
      const double t1 = robotTime(t + up);
      const double t2 = t1 + 1e-4;
      const double t3 = t + up + 1e-4 + down;
      sync.add(ns(t), ns(t1), ns(t2), ns(t3));
    }
  }
  static std::int64_t ns(double s) { return std::llround(s * 1e9); }
};

TEST(ClockSync, FindsOffsetAndDriftThroughJitter) {
  Exchanges link;
  ClockSync sync;
  link.run(sync, 0.0, 60.0, 0.002, 0.010);
  ASSERT_TRUE(sync.estimate().has_value());
  const double truth = link.robotTime(60.0) - 60.0;
  EXPECT_NEAR(sync.estimate()->offset_s, truth, 0.003);
  EXPECT_LE(std::abs(sync.estimate()->offset_s - truth), sync.estimate()->uncertainty_s + 0.001);
}

TEST(ClockSync, FollowsALongDriftWithinItsUncertainty) {
  Exchanges link;
  link.drift = 100e-6;
  ClockSync sync;
  link.run(sync, 0.0, 600.0, 0.0005, 0.0005);
  const auto robot = sync.toRobot(Exchanges::ns(600.0));
  ASSERT_TRUE(robot.has_value());
  EXPECT_NEAR(static_cast<double>(*robot) * 1e-9, link.robotTime(600.0), 0.0015);
  EXPECT_NEAR(sync.estimate()->drift_ppm, 100.0, 60.0);
}

TEST(ClockSync, ThereAndBackIsTheSameInstant) {
  Exchanges link;
  ClockSync sync;
  link.run(sync, 0.0, 20.0, 0.001, 0.001);
  const std::int64_t station = Exchanges::ns(25.0);
  EXPECT_NEAR(static_cast<double>(*sync.toStation(*sync.toRobot(station)) - station), 0.0, 1000.0);
}

TEST(ClockSync, StartsAnewWhenTheRobotsClockJumps) {
  Exchanges link;
  ClockSync sync;
  link.run(sync, 0.0, 20.0, 0.001, 0.001);
  link.offset_s = -40.0;  // restarted
  link.run(sync, 20.0, 20.5, 0.001, 0.001);
  EXPECT_EQ(sync.steps(), 1u);
  EXPECT_NEAR(sync.estimate()->offset_s, -40.0, 0.005);
}

TEST(ClockSync, OneSlowExchangeIsNoJump) {
  Exchanges link;
  ClockSync sync;
  link.run(sync, 0.0, 20.0, 0.001, 0.0005);
  sync.add(Exchanges::ns(20.0), Exchanges::ns(link.robotTime(20.8)),
           Exchanges::ns(link.robotTime(20.8)), Exchanges::ns(20.801));
  EXPECT_EQ(sync.steps(), 0u);
  EXPECT_NEAR(sync.estimate()->offset_s, link.robotTime(20.0) - 20.0, 0.003);
  EXPECT_NEAR(sync.estimate()->rtt_s, 0.801, 1e-3);
}

TEST(ClockSync, IgnoresExchangesThatCannotBe) {
  ClockSync sync;
  sync.add(100, 50, 40, 200);  // answered before received
  sync.add(200, 50, 60, 100);  // back before sent
  sync.add(100, 0, 500, 200);  // longer there than away
  EXPECT_FALSE(sync.estimate().has_value());
}

}  // namespace
}  // namespace kiln
