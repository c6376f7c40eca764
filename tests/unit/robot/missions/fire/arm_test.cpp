#include <gtest/gtest.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

TEST(ArmBlocked, WithdrawsAfterAContactAndSearchesAnew) {
  FireRig rig;
  rig.arm.failNext("cartesian", "contact");
  ASSERT_TRUE(rig.runToState("ArmBlocked"));
  const Vector6d q_contact = rig.arm_device.state()->q;
  const Vector6d q_before = rig.arm.goal();  // going back is under way
  EXPECT_GT((q_before - q_contact).cwiseAbs().maxCoeff(), 0.05);
  ASSERT_TRUE(rig.runToState("ArmSearch", 10.0));
  EXPECT_LT((rig.arm_device.state()->q - q_before).cwiseAbs().maxCoeff(), 1e-6);
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_TRUE(rig.place(0).extinguished);
}

TEST(ArmBlocked, GivesThePlaceUpTheSecondTime) {
  FireRig rig({.burning_place = 1});
  for (const char* kind : {"pose", "cartesian"}) {
    rig.arm.failNext(kind, "contact");
    ASSERT_TRUE(rig.runToState("ArmBlocked"));
    ASSERT_TRUE(rig.runUntil([&rig] { return rig.state() != "ArmBlocked"; }, 10.0));
  }
  EXPECT_EQ(rig.state(), "NextLocation");
  EXPECT_TRUE(rig.place(0).visited);
  EXPECT_EQ(rig.place(0).outcome, "arm blocked: arm stopped: contact");
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished") << "the other place burns";
  EXPECT_FALSE(rig.drove_extended);
}

TEST(ArmBlocked, StopsTheWaterWhenItHappensInThePattern) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("SpraySteady"));
  rig.arm.failNext("cartesian", "contact");
  ASSERT_TRUE(rig.runToState("ArmBlocked"));
  rig.run(0.1);
  EXPECT_FALSE(rig.pumpsRun());
  const double litres = rig.place(0).litres_est;
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_GT(litres, 1.9);
  EXPECT_NEAR(rig.place(0).litres_est, 4.0, 0.1) << "the second half follows after aiming anew";
}

TEST(ArmBlocked, APlaceOutOfReachIsGivenUp) {
  FireRig rig;
  rig.arm.reachable = [](const Eigen::Isometry3d&) { return false; };
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "NothingFound");
  EXPECT_EQ(rig.countVisits("AimHose"), 0);
  EXPECT_FALSE(rig.drove_extended);
}

TEST(ArmBlocked, AnArmThatCannotBeStowedEndsInTheSafeStopWithoutDriving) {
  FireRig rig({.start = false});
  for (int i = 0; i < 10; ++i) rig.arm.failNext("joints", "stuck");
  rig.host->start(rig.clock.now());
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "SafeStop");
  EXPECT_EQ(rig.base.drives, 0);
}

TEST(ArmBlocked, WhenOnlyThePatternIsOutOfReachTheRestIsSprayedSteadily) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("SpraySteady"));
  rig.arm.failNext("cartesian", "in_collision");
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_EQ(rig.countVisits("ArmBlocked"), 0);
}

TEST(ProtectiveStop, IsHeldUntilTheOperatorReleasesIt) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("SpraySteady"));
  rig.run(3.0);
  rig.arm_device.setSafety(ArmSafetyMode::ProtectiveStop);
  ASSERT_TRUE(rig.runToState("ProtectiveStop", 0.1));
  rig.run(0.1);
  EXPECT_FALSE(rig.pumpsRun());
  rig.run(120.0);
  EXPECT_EQ(rig.state(), "ProtectiveStop");
  EXPECT_EQ(rig.arm_device.releases(), 0) << "the mission never releases it by itself";
  ASSERT_TRUE(rig.arm_device.releaseProtectiveStop().has_value());
  ASSERT_TRUE(rig.runToState("ArmSearch", 5.0));
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
}

TEST(ProtectiveStop, WhileDrivingGoesOnDriving) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("DriveToLocation"));
  rig.run(0.5);
  rig.arm_device.setSafety(ArmSafetyMode::ProtectiveStop);
  ASSERT_TRUE(rig.runToState("ProtectiveStop", 0.1));
  EXPECT_FALSE(rig.base.moving());
  ASSERT_TRUE(rig.arm_device.releaseProtectiveStop().has_value());
  ASSERT_TRUE(rig.runToState("DriveToLocation", 5.0));
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
}

TEST(ProtectiveStop, OutsideGoesOnIntoTheBuilding) {
  FireRig rig;
  rig.run(4.0);
  rig.arm_device.setSafety(ArmSafetyMode::ProtectiveStop);
  rig.run(1.0);
  ASSERT_TRUE(rig.arm_device.releaseProtectiveStop().has_value());
  ASSERT_TRUE(rig.runToState("EnterBuilding", 5.0));
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
}

TEST(ProtectiveStop, ASecondOneAtThePlaceGivesItUp) {
  FireRig rig;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(rig.runToState("ArmSearch"));
    rig.arm_device.setSafety(ArmSafetyMode::ProtectiveStop);
    rig.run(1.0);
    ASSERT_EQ(rig.state(), "ProtectiveStop");
    ASSERT_TRUE(rig.arm_device.releaseProtectiveStop().has_value());
  }
  ASSERT_TRUE(rig.runToState("NextLocation", 5.0));
  EXPECT_EQ(rig.place(0).outcome, "protective stop");
}

TEST(ProtectiveStop, EndsTheMissionWhenTheClockRunsOut) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("ArmSearch"));
  rig.arm_device.setSafety(ArmSafetyMode::ProtectiveStop);
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "SafeStop");
  EXPECT_NEAR(rig.missionTime(), 900.0, 0.1);
}

}  // namespace
}  // namespace kiln
