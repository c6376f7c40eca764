#include <gmock/gmock.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

using testing::ElementsAre;

/// Without the repetitions that the warming plate causes.
std::vector<std::string> shortened(std::vector<std::string> states) {
  for (std::size_t i = 2; i + 1 < states.size();)
    if (states[i] == "ArmSearch" && states[i - 1] == "HeatFound")
      states.erase(states.begin() + static_cast<std::ptrdiff_t>(i),
                   states.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    else
      ++i;
  return states;
}

TEST(FireFlowchart, FireAtTheFirstPlaceIsSprayedAndTheSecondIsVisited) {
  FireRig rig;
  ASSERT_TRUE(rig.runToEnd()) << rig.state();
  EXPECT_THAT(
      shortened(rig.visited()),
      ElementsAre("EnterBuilding", "NextLocation", "DriveToLocation", "CheckPlace", "ArmSearch",
                  "HeatFound", "AimHose", "StartPump", "SpraySteady", "SprayPattern", "StopPump",
                  "NextLocation", "DriveToLocation", "CheckPlace", "ArmSearch", "HeatFound",
                  "NextLocation", "ParkArm", "Finished"));
  EXPECT_TRUE(rig.status().success);
  EXPECT_TRUE(rig.place(0).extinguished);
  EXPECT_TRUE(rig.place(1).visited);
  EXPECT_EQ(rig.place(1).outcome, "no heat source");
  EXPECT_NEAR(rig.place(0).litres_est, 4.0, 0.1);
  // The fake pumps do not fade as the tanks empty; the model expects 4 % less on the way from 5 to
  // 3 l.
  EXPECT_NEAR(rig.pumps_device.trueLitres(), 4.0 / 0.96, 0.1);
  EXPECT_TRUE(rig.armAt(rig.robot.q_park_deg));
  EXPECT_FALSE(rig.drove_extended);
  EXPECT_FALSE(rig.pumped_while_driving);
  EXPECT_LT(rig.missionTime(), 330.0);
}

TEST(FireFlowchart, FireAtTheSecondPlaceIsFound) {
  FireRig rig({.burning_place = 1});
  ASSERT_TRUE(rig.runToEnd()) << rig.state();
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_FALSE(rig.place(0).extinguished);
  EXPECT_TRUE(rig.place(1).extinguished);
  EXPECT_EQ(rig.place(0).litres_est, 0.0);
  EXPECT_FALSE(rig.drove_extended);
}

TEST(FireFlowchart, FirstHalfOfTheWaterIsSteadyAndTheSecondTilts) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("SpraySteady"));
  const Vector6d q_start = rig.arm_device.state()->q;
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).litres_est > 1.9; }));
  EXPECT_EQ(rig.state(), "SpraySteady");
  EXPECT_LT((rig.arm_device.state()->q - q_start).cwiseAbs().maxCoeff(), 1e-6);
  ASSERT_TRUE(rig.runToState("SprayPattern"));
  EXPECT_NEAR(rig.place(0).litres_est, 2.0, 0.01);
  double tilted = 0.0;
  rig.runUntil([&] {
    tilted = std::max(tilted, (rig.arm_device.state()->q - q_start).cwiseAbs().maxCoeff());
    return rig.state() != "SprayPattern";
  });
  EXPECT_GT(tilted, 0.02);
  EXPECT_EQ(rig.state(), "StopPump");
  EXPECT_NEAR(rig.place(0).litres_est, 4.0, 0.01);
}

TEST(FireFlowchart, NoFireMeansTwoRoundsAndNoSuccess) {
  FireRig rig({.burning_place = -1});
  ASSERT_TRUE(rig.runToEnd()) << rig.state();
  EXPECT_EQ(rig.state(), "NothingFound");
  EXPECT_FALSE(rig.status().success);
  EXPECT_EQ(rig.countVisits("DriveToLocation"), 4);
  EXPECT_EQ(rig.countVisits("AimHose"), 0);
  EXPECT_EQ(rig.pumps_device.trueLitres(), 0.0);
  EXPECT_TRUE(rig.armAt(rig.robot.q_park_deg));
}

TEST(FireFlowchart, EndsWhenTheClockIsNearlyOverWithWaterDelivered) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("StopPump"));
  ASSERT_TRUE(rig.runToState("DriveToLocation"));
  rig.belief.clock_start = rig.clock.now() - fromSeconds(869.0);
  ASSERT_TRUE(rig.runToState("TimeNearlyOver", 2.0));
  ASSERT_TRUE(rig.runToEnd(60.0));
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_TRUE(rig.armAt(rig.robot.q_park_deg));
  EXPECT_FALSE(rig.base.moving());
}

TEST(FireFlowchart, EndsWhenTheClockIsNearlyOverWhileSpraying) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("SpraySteady"));
  rig.run(2.0);
  ASSERT_TRUE(rig.pumpsRun());
  rig.belief.clock_start = rig.clock.now() - fromSeconds(870.0);
  ASSERT_TRUE(rig.runToState("TimeNearlyOver", 2.0));
  rig.run(0.1);
  EXPECT_FALSE(rig.pumpsRun());
  ASSERT_TRUE(rig.runToEnd(60.0));
  EXPECT_EQ(rig.state(), "SafeStop") << "the water was not delivered";
  EXPECT_LT(rig.missionTime(), 900.0);
}

}  // namespace
}  // namespace kiln
