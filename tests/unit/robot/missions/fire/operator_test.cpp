#include <gtest/gtest.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

TEST(FirePause, StopsTheWaterAndGoesOnWhereItWas) {
  FireRig rig;
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).litres_est > 1.0; }));
  rig.host->hold(HoldReason::OperatorPause, "paused by Ada", rig.clock.now());
  rig.run(0.1);
  EXPECT_FALSE(rig.pumpsRun());
  rig.run(30.0);
  EXPECT_LT(rig.place(0).litres_est, 1.1);
  rig.host->resume(rig.clock.now());
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_NEAR(rig.place(0).litres_est, 4.0, 0.1);
}

TEST(FirePause, APausedMissionWritesNoSetpoints) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("DriveToLocation"));
  rig.run(0.5);
  rig.host->hold(HoldReason::OperatorPause, "Ada drives by hand", rig.clock.now());
  EXPECT_FALSE(rig.base.moving());
  const Pose2 here = rig.base.pose();
  rig.run(5.0);
  EXPECT_EQ(rig.base.pose().x_m, here.x_m);
  EXPECT_FALSE(rig.arm.moving());
}

TEST(FirePause, ANozzleMovedByHandIsAimedAnew) {
  FireRig rig;
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).litres_est > 1.0; }));
  rig.host->hold(HoldReason::OperatorPause, "Ada drives by hand", rig.clock.now());
  Vector6d q = rig.arm_device.state()->q;
  q[0] += 0.3;
  rig.arm_device.setQ(q);
  rig.host->resume(rig.clock.now());
  rig.run(0.1);
  EXPECT_FALSE(rig.pumpsRun()) << "no water past the opening";
  EXPECT_EQ(rig.state(), "AimHose");
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
}

TEST(FirePause, WaterByHandCountsForThePlace) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("AimHose"));
  rig.host->hold(HoldReason::OperatorPause, "Ada drives by hand", rig.clock.now());
  for (int i = 0; i < 500; ++i) {
    PumpSetpoint setpoint;
    setpoint.stamp = rig.clock.now();
    setpoint.duty = {1.0, 1.0};
    rig.pumps->setpoint(setpoint);
    rig.run(0.02);
  }
  EXPECT_NEAR(rig.place(0).litres_est, 10.0 / 60.0 * 3.2, 0.05);
}

TEST(FireReset, StartsAgainAndKeepsWhatItKnows) {
  FireRig rig({.burning_place = 1});
  ASSERT_TRUE(rig.runUntil([&rig] { return rig.place(0).visited && rig.state() == "ArmSearch"; }));
  const double elapsed_s = rig.missionTime();
  rig.base.carryTo(rig.arena.start.pose());
  rig.arm_device.setQ(RobotGeometry::radians(rig.robot.q_park_deg));
  rig.host->onReset(rig.clock.now());
  rig.run(0.1);
  EXPECT_EQ(rig.state(), "EnterBuilding");
  EXPECT_EQ(rig.belief.resets, 1);
  EXPECT_GE(rig.missionTime(), elapsed_s) << "the clock runs on";
  EXPECT_TRUE(rig.place(0).visited);
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_FALSE(rig.drove_extended);
}

TEST(FireReset, WhilePausedWaitsForTheOperator) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("ArmSearch"));
  rig.host->hold(HoldReason::OperatorPause, "paused by Ada", rig.clock.now());
  rig.base.carryTo(rig.arena.start.pose());
  rig.host->onReset(rig.clock.now());
  rig.run(5.0);
  EXPECT_EQ(rig.state(), "EnterBuilding");
  EXPECT_FALSE(rig.base.moving() || rig.arm.moving());
  rig.host->resume(rig.clock.now());
  EXPECT_TRUE(rig.runToState("ArmSearch"));
}

TEST(FireOperator, IsToldWhyAStateCannotBeEntered) {
  FireRig rig;
  rig.run(1.0);
  EXPECT_EQ(rig.force("ArmSearch").reason, "no fire place is selected; enter Next location first");
  EXPECT_EQ(rig.force("SpraySteady").outcome, ChangeStateOutcome::Denied);
  EXPECT_EQ(rig.force("ArmBlocked").outcome, ChangeStateOutcome::NeedsArguments);
  EXPECT_EQ(rig.force("Fly").outcome, ChangeStateOutcome::NoSuchState);
  EXPECT_EQ(rig.state(), "EnterBuilding");
}

TEST(FireOperator, CanForceAnEndAndTakeItBack) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("SpraySteady"));
  rig.run(2.0);
  ASSERT_EQ(rig.force("SafeStop").outcome, ChangeStateOutcome::Ok);
  rig.run(0.1);
  EXPECT_FALSE(rig.pumpsRun());
  EXPECT_TRUE(rig.status().terminal);
  ASSERT_EQ(rig.force("ArmSearch").outcome, ChangeStateOutcome::Ok);
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
}

TEST(FireOperator, ForcingNextLocationOutsideStillEntersTheBuildingFirst) {
  FireRig rig;
  rig.run(1.0);
  ASSERT_EQ(rig.force("NextLocation").outcome, ChangeStateOutcome::Ok);
  rig.run(0.04);
  EXPECT_EQ(rig.state(), "EnterBuilding");
}

}  // namespace
}  // namespace kiln
