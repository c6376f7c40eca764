#include "robot/sim_link/clock_map.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

Stamp ms(std::int64_t t) { return stampFromNanoseconds(t * 1'000'000); }

TEST(ClockMap, TakesTheLeastDelay) {
  ClockMap map;
  map.observe(ms(1005), ms(0));
  map.observe(ms(1009), ms(8));  // 1001: the quickest
  map.observe(ms(1019), ms(16));
  EXPECT_EQ(map.shift(), std::chrono::milliseconds(1001));
}

TEST(ClockMap, NoMappedStampLiesInTheFuture) {
  ClockMap map;
  std::uint64_t state = 1;
  for (std::int64_t t = 0; t < 20000; t += 8) {
    state = state * 6364136223846793005ULL + 1;
    const Stamp arrival = ms(t + 500 + static_cast<std::int64_t>(state >> 60));  // 0 to 15 ms late
    map.observe(arrival, ms(t));
    ASSERT_LE(ms(t) + map.shift(), arrival);
  }
  EXPECT_EQ(map.shift(), std::chrono::milliseconds(500));
}

TEST(ClockMap, FollowsAWorldThatFallsBehindWithinTwoWindows) {
  ClockMap map;
  for (std::int64_t t = 0; t < 3000; t += 8) map.observe(ms(t + 100), ms(t));
  for (std::int64_t t = 3000; t < 5100; t += 8) map.observe(ms(t + 400), ms(t));  // it lost 300 ms
  EXPECT_EQ(map.shift(), std::chrono::milliseconds(400));
}

TEST(ClockMap, FollowsAWorldThatSaysItWaitedAtOnce) {
  ClockMap map;
  for (std::int64_t t = 0; t < 3000; t += 8) map.observe(ms(t + 100), ms(t));
  map.observe(ms(3408), ms(3008), std::chrono::milliseconds(300));
  EXPECT_EQ(ms(3008) + map.shift(), ms(3408));
}

}  // namespace
}  // namespace kiln
