#include "common/core/clock.h"

#include <regex>

#include <gtest/gtest.h>

namespace kiln {
namespace {

using std::chrono::milliseconds;

TEST(Stamp, RoundsSecondsToTheNearestNanosecondOnBothSidesOfZero) {
  EXPECT_EQ(fromSeconds(0.1).count(), 100'000'000);
  EXPECT_EQ(fromSeconds(1.6e-9).count(), 2);
  EXPECT_EQ(fromSeconds(-1.6e-9).count(), -2);
  EXPECT_DOUBLE_EQ(toSeconds(stampFromNanoseconds(-250'000'000)), -0.25);
  EXPECT_EQ(toNanoseconds(stampFromNanoseconds(1234567890123456789)), 1234567890123456789);
}

TEST(ManualClock, MovesOnlyWhenTold) {
  ManualClock clock(Stamp{milliseconds(5)});
  EXPECT_EQ(clock.now(), Stamp{milliseconds(5)});
  clock.advanceBy(milliseconds(10));
  EXPECT_EQ(clock.now(), Stamp{milliseconds(15)});
  clock.advanceTo(clock.now());  // standing still is allowed
  EXPECT_EQ(clock.now(), Stamp{milliseconds(15)});
}

TEST(ManualClockDeathTest, RefusesToRunBackwards) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(
      {
        ManualClock clock(Stamp{milliseconds(5)});
        clock.advanceTo(Stamp{milliseconds(4)});
      },
      "clock would run backwards");
}

TEST(SteadyClock, NeverRunsBackwards) {
  const SteadyClock clock;
  Stamp last = clock.now();
  for (int i = 0; i < 1000; ++i) {
    const Stamp now = clock.now();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST(WallTime, IsIso8601InUtc) {
  EXPECT_TRUE(
      std::regex_match(wallTimeIso8601(), std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ)")));
}

}  // namespace
}  // namespace kiln
