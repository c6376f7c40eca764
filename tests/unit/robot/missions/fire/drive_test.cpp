#include <gtest/gtest.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

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
