#include <gtest/gtest.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

TEST(FireSearch, DoesNotConcludeWhileThePlaceIsStillWarming) {
  FireRig rig;
  rig.base.carryTo(
      rig.arena.entry_path.back().pose());  // much faster than driving: sweeps from 10 s on
  ASSERT_TRUE(rig.runToState("HeatFound"));
  EXPECT_LT(rig.missionTime(), 38.0) << "the plate is not above 75 degC yet";
  rig.run(0.04);
  EXPECT_EQ(rig.state(), "ArmSearch");
  EXPECT_EQ(rig.noteOf("ArmSearch"), "the place is still warming");
  ASSERT_TRUE(rig.runToState("AimHose", 60.0)) << "it is found at the same place once it is hot";
  EXPECT_EQ(rig.mission->belief().current_place, 0);
}

TEST(FireSearch, APlaceWhereNothingWarmsIsLeftAfterOneSweepHoweverEarly) {
  FireRig rig({.burning_place = 1});
  rig.base.carryTo(rig.arena.entry_path.back().pose());
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).visited; }, 120.0));
  EXPECT_EQ(rig.place(0).outcome, "no heat source");
  EXPECT_EQ(rig.countVisits("ArmSearch"), 1);
  EXPECT_LT(rig.missionTime(), 45.0);
}

TEST(FireSearch, WhatIsMerelyWarmAtThePlaceIsNotWaitedFor) {
  FireRig rig;
  rig.steady_c = 60.0;
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).visited; }, 200.0));
  EXPECT_EQ(rig.countVisits("ArmSearch"), 1);
}

TEST(FireSearch, RefusesAHeatSourceFarFromTheConfiguredPlace) {
  FireRig rig;
  rig.steady_c = 120.0;
  rig.sweep.p_plate_map += Eigen::Vector3d(0.0, 0.60, 0.0);
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).visited; }, 200.0));
  EXPECT_NE(rig.place(0).outcome.find("off its place"), std::string::npos) << rig.place(0).outcome;
  EXPECT_EQ(rig.countVisits("AimHose"), 0);
}

TEST(FireSearch, SearchesAgainWhenTheCameraGaveNoUsableImage) {
  FireRig rig;
  rig.run(60.0);
  ASSERT_TRUE(rig.force("DriveToLocation").outcome == ChangeStateOutcome::Ok);
  rig.camera_frozen = true;
  ASSERT_TRUE(rig.runToState("HeatFound"));
  rig.run(0.04);
  EXPECT_EQ(rig.state(), "ArmSearch");
  EXPECT_EQ(rig.noteOf("ArmSearch"), "no usable thermal image");
  rig.camera_frozen = false;
  EXPECT_TRUE(rig.runToState("AimHose", 60.0));
}

TEST(FireSearch, ShowsWhyItWaits) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("ArmSearch"));
  rig.run(1.0);
  const FsmStatus status = rig.status();
  ASSERT_EQ(status.guards.size(), 2u);
  EXPECT_EQ(status.guards[0].name, "Thermal images arrive");
  EXPECT_TRUE(status.guards[0].met);
  EXPECT_GE(status.guards[0].input_age_s, 0.0);
  EXPECT_LT(status.guards[0].input_age_s, 0.2);
}

}  // namespace
}  // namespace kiln
