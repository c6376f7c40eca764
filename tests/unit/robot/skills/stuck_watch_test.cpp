#include "robot/skills/stuck_watch.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

constexpr double kTick_s = 0.02;

/// Drives for `seconds`: commanded, measured by the wheels and moved in map along X, m/s.
bool everStuck(StuckWatch& watch, double seconds, double commanded, double measured, double moved) {
  bool stuck = false;
  watch.restart(Stamp{}, {});
  for (int i = 1; i * kTick_s <= seconds; ++i) {
    const double t = i * kTick_s;
    stuck |= watch.update(Stamp{fromSeconds(t)}, kTick_s, {moved * t, 0, 0}, {commanded, 0, 0},
                          {measured, 0, 0});
  }
  return stuck;
}

TEST(StuckWatch, WheelsThatDoNotTurnAndWheelsThatSpinOnTheSpotAreStuck) {
  StuckWatch watch({2.0, 0.3, 1.0});
  EXPECT_FALSE(everStuck(watch, 6.0, 0.5, 0.5, 0.5));
  EXPECT_TRUE(everStuck(watch, 6.0, 0.5, 0.0, 0.0)) << "blocked";
  EXPECT_TRUE(everStuck(watch, 6.0, 0.5, 0.5, 0.0)) << "they slip";
  EXPECT_FALSE(everStuck(watch, 1.5, 0.5, 0.0, 0.0)) << "the window is not over";
}

TEST(StuckWatch, SeesItWithinOneWindowWheneverItBegins) {
  for (const double begin : {0.5, 1.0, 1.5}) {
    StuckWatch watch({2.0, 0.3, 1.0});
    watch.restart(Stamp{}, {});
    double seen_s = 0.0, moved_m = 0.0;
    for (int i = 1; seen_s == 0.0 && i < 500; ++i) {
      moved_m += i * kTick_s < begin ? 0.5 * kTick_s : 0.0;
      if (watch.update(Stamp{fromSeconds(i * kTick_s)}, kTick_s, {moved_m, 0, 0}, {0.5, 0, 0},
                       {0.5, 0, 0}))
        seen_s = i * kTick_s;
    }
    // 0.3 x 1 m is still covered when the window begins 0.6 s before the standstill.
    EXPECT_NEAR(seen_s, std::max(2.0, begin + 1.4), 0.05) << begin;
  }
}

TEST(StuckWatch, LittleCommandedWayProvesNothing) {
  StuckWatch watch({2.0, 0.3, 1.0});
  EXPECT_FALSE(everStuck(watch, 10.0, 0.1, 0.0, 0.0));  // 0.2 m a window
}

TEST(StuckWatch, TurningCountsByItsLever) {
  StuckWatch watch({2.0, 0.3, 1.0});
  watch.restart(Stamp{}, {});
  bool stuck = false;
  for (int i = 1; i <= 200; ++i) {
    const double t = i * kTick_s;
    stuck |= watch.update(Stamp{fromSeconds(t)}, kTick_s, {0, 0, wrapAngle(0.4 * t)}, {0, 0, 0.4},
                          {0, 0, 0.4});
  }
  EXPECT_FALSE(stuck);
}

}  // namespace
}  // namespace kiln
