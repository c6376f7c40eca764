#include <algorithm>

#include <gtest/gtest.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

TEST(StowedDrive, TheBaseStartsWhenTheArmsMotionHasEndedAndNotWhenItIsNearlyThere) {
  FireRig rig;
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.arm.moving(); }));
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.base.moving(); }));
  EXPECT_FALSE(rig.arm.moving());
}

TEST(StowedDrive, AWheelThatStandsAgainstTheEdgeTakesARunUp) {
  FireRig rig;
  const double edge_m = rig.arena.approach.edge_x_m, wheel_m = rig.robot.wheel_x_m;
  rig.base.carryTo({edge_m - wheel_m - 0.055, 0.1, 0.0});
  double furthest_back_m = 1e9;
  ASSERT_TRUE(rig.runUntil([&] {
    furthest_back_m = std::min(furthest_back_m, rig.base.pose().x_m);
    return rig.state() == "NextLocation";
  }));
  EXPECT_NEAR(furthest_back_m, edge_m - wheel_m - 0.6, 0.03);
  EXPECT_EQ(rig.base.drives, 2);
}

TEST(DriveBlocked, TriesTheEntryOnceMore) {
  FireRig rig;
  rig.base.failNext(1);
  ASSERT_TRUE(rig.runToState("DriveBlocked"));
  ASSERT_TRUE(rig.runToState("EnterBuilding", 5.0));
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
}

TEST(DriveBlocked, ABuildingThatCannotBeEnteredIsTheSafeStop) {
  FireRig rig;
  rig.base.failNext(2);
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "SafeStop");
  EXPECT_EQ(rig.countVisits("DriveBlocked"), 2);
}

TEST(DriveBlocked, APlaceThatCannotBeReachedIsLeftOut) {
  FireRig rig({.burning_place = 1});
  ASSERT_TRUE(rig.runToState("NextLocation"));
  rig.base.failNext(2);
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).visited; }));
  EXPECT_EQ(rig.place(0).outcome, "cannot be reached: the wheels do not turn");
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
}

TEST(DriveBlocked, ADriveThatTakesTooLongIsAFault) {
  FireRig rig;
  rig.base.stickForever();
  ASSERT_TRUE(rig.runToState("DriveBlocked", 125.0));
}

}  // namespace
}  // namespace kiln
