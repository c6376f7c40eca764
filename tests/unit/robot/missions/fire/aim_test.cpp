#include <algorithm>

#include <gtest/gtest.h>

#include "robot/missions/fire/skills/jet.h"
#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

Eigen::Isometry3d nozzle(const FireRig& rig) {
  return toIsometry(rig.base.pose()) * rig.robot.X_base_flange(rig.arm_device.state()->q) *
         rig.robot.X_flange_nozzle.pose();
}

TEST(AimHose, EndsWhereTheJetPassesThroughTheOpening) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("StartPump"));
  const Eigen::Vector3d normal(-1, 0, 0);  // place 1 faces 180 deg
  const Eigen::Vector3d p_opening = rig.sweep.p_plate_map + rig.site().recess_m * normal;
  // Flow scale in the middle of the water to come: each tank at 4 of 5 l -> 1 - 0.2 * 0.2.
  const JetMiss miss = jetMiss(SprayCalibration{}, nozzle(rig), p_opening, normal, 0.96);
  ASSERT_TRUE(miss.reaches);
  EXPECT_LT(miss.distance_m, 0.015);
  EXPECT_LT(miss.angle_rad, 0.2);
}

TEST(AimHose, MovesInStepsOfAtMostTenCentimetres) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("AimHose"));
  Eigen::Vector3d stopped_at = nozzle(rig).translation();
  bool was_moving = false;
  int steps = 0;
  double longest = 0.0;
  rig.runUntil([&] {
    if (was_moving && !rig.arm.moving()) {
      longest = std::max(longest, (nozzle(rig).translation() - stopped_at).norm());
      stopped_at = nozzle(rig).translation();
      ++steps;
    }
    was_moving = rig.arm.moving();
    return rig.state() != "AimHose";
  });
  EXPECT_EQ(rig.state(), "StartPump");
  EXPECT_GE(steps, 2);
  EXPECT_LE(longest, 0.101);
}

TEST(AimHose, FollowsTheEstimateWhileItImproves) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("AimHose"));
  rig.sweep.p_plate_map += Eigen::Vector3d(0.02, 0.05, 0.03);
  ASSERT_TRUE(rig.runToState("StartPump"));
  const Eigen::Vector3d normal(-1, 0, 0);
  const Eigen::Vector3d p_opening = rig.sweep.p_plate_map + rig.site().recess_m * normal;
  EXPECT_LT(jetMiss(SprayCalibration{}, nozzle(rig), p_opening, normal, 0.96).distance_m, 0.015);
}

TEST(AimHose, WaitsWhileTheEstimateIsTooUncertain) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("AimHose"));
  rig.sweep.sigma_m = 0.05;
  rig.run(30.0);
  ASSERT_EQ(rig.state(), "AimHose");
  const auto guards = rig.status().guards;
  const auto guard = std::find_if(guards.begin(), guards.end(), [](const GuardStatus& g) {
    return g.name == "Estimate within 3 cm";
  });
  ASSERT_NE(guard, guards.end());
  EXPECT_FALSE(guard->met);
  EXPECT_EQ(guard->detail, "5.0 cm");
  EXPECT_EQ(rig.pumps_device.trueLitres(), 0.0);
  rig.sweep.sigma_m = 0.01;
  EXPECT_TRUE(rig.runToState("StartPump", 10.0));
}

TEST(AimHose, GivesUpAnUncertainEstimateAtItsTimeLimit) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("AimHose"));
  rig.sweep.sigma_m = 0.05;
  ASSERT_TRUE(rig.runToState("LostTarget", 61.0));
  EXPECT_EQ(rig.status().history.back().cause, TransitionCause::Timeout);
}

TEST(LostTarget, SearchesAnewOnceAndThenSprays) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("AimHose"));
  rig.hidden = true;
  ASSERT_TRUE(rig.runToState("LostTarget", 10.0));
  rig.hidden = false;
  ASSERT_TRUE(rig.runToState("ArmSearch", 1.0));
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_TRUE(rig.place(0).extinguished);
}

TEST(LostTarget, GoesToTheNextLocationTheSecondTime) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("AimHose"));
  rig.hidden = true;
  ASSERT_TRUE(rig.runToState("LostTarget", 10.0));
  rig.hidden = false;
  ASSERT_TRUE(rig.runToState("AimHose", 60.0));
  rig.hidden = true;
  ASSERT_TRUE(rig.runToState("LostTarget", 10.0));
  ASSERT_TRUE(rig.runToState("NextLocation", 1.0));
  EXPECT_EQ(rig.place(0).outcome, "heat source lost while aiming");
  EXPECT_EQ(rig.pumps_device.trueLitres(), 0.0);
  // A second round finds it again when it can be seen.
  rig.hidden = false;
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_EQ(rig.mission->belief().search_round, 2);
}

TEST(LostTarget, AFrozenShutterIsNotALoss) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("AimHose"));
  rig.run(1.0);
  rig.camera_frozen = true;  // longer than any shutter, shorter than the image limit allows nothing
  rig.run(0.6);
  rig.camera_frozen = false;
  ASSERT_TRUE(rig.runToState("StartPump", 30.0));
  EXPECT_EQ(rig.countVisits("LostTarget"), 0);
}

TEST(LostTarget, ADeadCameraIsALoss) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("AimHose"));
  rig.camera_dead = true;
  EXPECT_TRUE(rig.runToState("LostTarget", 4.0));
}

}  // namespace
}  // namespace kiln
