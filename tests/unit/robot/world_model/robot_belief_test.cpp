#include "robot/world_model/robot_belief.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace kiln {
namespace {

Stamp at(double s) { return Stamp{} + fromSeconds(s); }

/// Every field differs from its default.
RobotBelief full() {
  RobotBelief belief;
  belief.startClock(stampFromNanoseconds(123456789012345));
  belief.resets = 2;
  belief.X_map_base = {1.5, -2.5, 0.25};
  belief.pose_stamp = at(11);
  belief.device_resets = 5;
  return belief;
}

RobotBelief restored(double started_s, double saved_s, double now_s) {
  RobotBelief belief;
  belief.startClock(at(started_s));
  belief.continueClock(at(saved_s), at(now_s));
  return belief;
}

TEST(RobotBelief, ItsClockRunsFromItsStart) {
  RobotBelief belief;
  EXPECT_EQ(belief.elapsedS(at(50.0)), 0.0);
  belief.startClock(at(100.0));
  EXPECT_NEAR(belief.elapsedS(at(160.0)), 60.0, 1e-9);
}

TEST(RobotBelief, DowntimeCountsWhenRobotTimeRanOn) {
  EXPECT_NEAR(restored(100.0, 160.0, 170.0).elapsedS(at(170.0)), 70.0, 1e-9);
}

TEST(RobotBelief, ClockGoesOnFromItsStandWhenRobotTimeBeganAnew) {
  const RobotBelief belief = restored(100.0, 160.0, 5.0);  // the computer was restarted
  EXPECT_NEAR(belief.elapsedS(at(5.0)), 60.0, 1e-9);
  EXPECT_NEAR(belief.elapsedS(at(15.0)), 70.0, 1e-9);
}

TEST(RobotBelief, ComesBackAsItWas) {
  const nlohmann::json once = beliefToJson(full());
  const auto back = beliefFromJson(nlohmann::json::parse(once.dump()));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(beliefToJson(*back).dump(), once.dump());
  EXPECT_EQ(back->clock_start, full().clock_start);
  EXPECT_EQ(back->device_resets, 5U);
  EXPECT_FALSE(beliefFromJson(beliefToJson(RobotBelief{}))->device_resets.has_value());
}

TEST(RobotBelief, RefusesWhatIsMissingOrOutOfRangeByName) {
  const nlohmann::json whole = beliefToJson(full());
  for (const auto& item : whole.items()) {
    if (item.key() == "device_resets") continue;  // not heard yet
    nlohmann::json damaged = whole;
    damaged.erase(item.key());
    const auto back = beliefFromJson(damaged);
    ASSERT_FALSE(back.has_value()) << item.key();
    EXPECT_NE(back.error().message.find(item.key()), std::string::npos) << back.error().message;
  }
  RobotBelief far = full();
  far.X_map_base.x_m = 1e9;
  EXPECT_NE(beliefFromJson(beliefToJson(far)).error().message.find("X_map_base"),
            std::string::npos);
  RobotBelief nan = full();
  nan.X_map_base.x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(beliefFromJson(nlohmann::json::parse(beliefToJson(nan).dump())).has_value());
  RobotBelief negative = full();
  negative.resets = -1;
  EXPECT_NE(beliefFromJson(beliefToJson(negative)).error().message.find("resets"),
            std::string::npos);
}

}  // namespace
}  // namespace kiln
