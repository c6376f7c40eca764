#include <gtest/gtest.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

TEST(PumpFault, RetriesOnceAndGoesOnWhenThePumpRecovers) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("StartPump"));
  rig.pumps_device.setDry(0, true);
  rig.pumps_device.setDry(1, true);
  ASSERT_TRUE(rig.runToState("PumpFault", 4.0));
  rig.run(0.1);
  EXPECT_FALSE(rig.pumpsRun()) << "off while resting";
  rig.pumps_device.setDry(0, false);
  rig.pumps_device.setDry(1, false);
  ASSERT_TRUE(rig.runToState("SpraySteady", 5.0));
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
}

TEST(PumpFault, GoesOnWithTheOtherPump) {
  FireRig rig;
  rig.pumps_device.setDry(0, true);
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_EQ(rig.countVisits("PumpFault"), 2);
  EXPECT_FALSE(rig.mission->belief().pump_usable[0]);
  EXPECT_TRUE(rig.mission->belief().pump_usable[1]);
  EXPECT_TRUE(rig.place(0).extinguished);
}

TEST(PumpFault, BothPumpsDeadMeansNextPlaceThenSafeStop) {
  FireRig rig;
  rig.pumps_device.setDry(0, true);
  rig.pumps_device.setDry(1, true);
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).visited; }));
  EXPECT_EQ(rig.countVisits("PumpFault"), 2);
  EXPECT_EQ(rig.place(0).outcome, "the pumps do not run");
  ASSERT_TRUE(rig.runToState("DriveToLocation", 5.0)) << "a second place is left";
  EXPECT_EQ(rig.mission->belief().current_place, 1);
}

TEST(PumpFault, WithNoPlaceLeftItIsTheSafeStop) {
  FireRig rig({.burning_place = 1});
  rig.pumps_device.setDry(0, true);
  rig.pumps_device.setDry(1, true);
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "SafeStop");
  EXPECT_FALSE(rig.status().success);
}

TEST(PumpFault, IsNoticedInTheMiddleOfSpraying) {
  FireRig rig;
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).litres_est > 1.0; }));
  rig.pumps_device.setDry(0, true);
  rig.pumps_device.setDry(1, true);
  ASSERT_TRUE(rig.runToState("PumpFault", 1.0));
  EXPECT_NE(rig.noteOf("PumpFault").find("no current"), std::string::npos);
  rig.pumps_device.setDry(0, false);
  rig.pumps_device.setDry(1, false);
  ASSERT_TRUE(rig.runToState("SpraySteady", 5.0));
  EXPECT_GT(rig.place(0).litres_est, 1.0) << "goes on where it was, it does not begin at zero";
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_NEAR(rig.place(0).litres_est, 4.0, 0.1);
}

TEST(PumpFault, ASilentPumpBoardIsAFault) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("SpraySteady"));
  rig.run(5.0);
  rig.pumps_device.freezeState(true);
  EXPECT_TRUE(rig.runToState("PumpFault", 5.0));
}

}  // namespace
}  // namespace kiln
