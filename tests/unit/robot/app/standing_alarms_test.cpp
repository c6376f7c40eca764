#include "robot/app/standing_alarms.h"

#include <gtest/gtest.h>

#include "robot/app/preflight.h"

namespace kiln {
namespace {

const Stamp kNow{std::chrono::seconds(100)};

TEST(StandingAlarms, ALidarThatFellSilentIsAnAlarmUntilItDeliversAgain) {
  AlarmBook alarms;
  const PreflightLimits limits;
  PreflightInputs in;
  setLidarAlarm(alarms, silentLidar(in, limits), kNow);
  EXPECT_TRUE(alarms.list().empty()) << "it never delivered: a check, no alarm";
  in.lidar_age_s = limits.lidar_age_s + 0.1;
  setLidarAlarm(alarms, silentLidar(in, limits), kNow);
  ASSERT_EQ(alarms.list().size(), 1U);
  EXPECT_TRUE(alarms.list()[0].active);
  EXPECT_EQ(alarms.list()[0].level, AlarmLevel::Warning);
  EXPECT_NE(alarms.list()[0].text.find("no scan for"), std::string::npos);
  in.lidar_age_s = 0.1;
  setLidarAlarm(alarms, silentLidar(in, limits), kNow);
  EXPECT_FALSE(alarms.list()[0].active);
}

TEST(StandingAlarms, AStopByTheMotionWatchIsAnAlarmAndOneByAHandIsNone) {
  AlarmBook alarms;
  StopLatch stop;
  (void)stop.set("Ann", kNow);
  setMotionWatchAlarm(alarms, stop, kNow);
  EXPECT_TRUE(alarms.list().empty());
  ASSERT_TRUE(stop.clear(stop.generation()));
  (void)stop.set("motion watch: the wheels do not follow", kNow);
  setMotionWatchAlarm(alarms, stop, kNow);
  ASSERT_EQ(alarms.list().size(), 1U);
  EXPECT_EQ(alarms.list()[0].text, "STOP by motion watch: the wheels do not follow");
  ASSERT_TRUE(stop.clear(stop.generation()));
  setMotionWatchAlarm(alarms, stop, kNow);
  EXPECT_FALSE(alarms.list()[0].active);
}

}  // namespace
}  // namespace kiln
