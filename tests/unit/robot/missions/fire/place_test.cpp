#include <gmock/gmock.h>

#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

TEST(CheckPlace, TheArmUnfoldsOnlyBeforeAPlaceThatStandsWhereItShould) {
  FireRig rig;
  rig.place_look.misplaced = {0.2, 0.1, 0.0};
  ASSERT_TRUE(rig.runToState("PlaceRefused")) << rig.state();
  EXPECT_EQ(rig.countVisits("ArmSearch"), 0);
  EXPECT_EQ(rig.place_look.asked, rig.config.check.max_looks) << "looks again before it refuses";
  ASSERT_EQ(rig.mission->placeChecks().size(), 1u);
  EXPECT_EQ(rig.mission->placeChecks()[0].verdict, PlaceVerdict::Misplaced);
  rig.run(5.0);
  EXPECT_EQ(rig.state(), "PlaceRefused") << "waits for the operator";
  EXPECT_THAT(rig.status().display_text, testing::HasSubstr("place 1 stands elsewhere"));
  EXPECT_TRUE(rig.armAt(rig.robot.q_drive_deg));
}

TEST(CheckPlace, ANudgeIsCheckedAndTheMissionGoesOnWithThePlaceWhereItIs) {
  FireRig rig;
  rig.place_look.misplaced = {0.2, 0.1, 0.05};
  const Eigen::Isometry3d before =
      rig.site().front(rig.place(0).p_plate_map, rig.place(0).facing_rad);
  const Pose2 work_before = rig.site().places[0].work_pose.pose();
  ASSERT_TRUE(rig.runToState("PlaceRefused")) << rig.state();
  const Pose2 correction = rig.mission->placeChecks()[0].correction();
  ASSERT_TRUE(rig.mission->nudgePlace("place 1", correction).has_value());
  const Eigen::Isometry3d after =
      rig.site().front(rig.place(0).p_plate_map, rig.place(0).facing_rad);
  EXPECT_NEAR((after.translation() - before.translation() - Eigen::Vector3d(0.2, 0.1, 0)).norm(),
              0.0, 1e-9);
  EXPECT_NEAR(wrapAngle(projectToGround(after).yaw_rad - projectToGround(before).yaw_rad), 0.05,
              1e-9);
  EXPECT_NEAR(rig.mission->placeChecks()[0].correction().x_m, 0.0, 1e-9) << "shown where it is now";
  EXPECT_NEAR(rig.mission->site(rig.clock.now()).places[0].nudge.yaw_rad, 0.05, 1e-12);
  // The robot works from the same pose relative to the place, and plans with the moved box.
  const Pose2 seen_before = inverse(projectToGround(before)) * work_before;
  const Pose2 seen_after = inverse(projectToGround(after)) * rig.site().places[0].work_pose.pose();
  EXPECT_NEAR(std::hypot(seen_before.x_m - seen_after.x_m, seen_before.y_m - seen_after.y_m), 0.0,
              1e-9);
  rig.sweep.p_plate_map = rig.place(0).p_plate_map;
  ASSERT_TRUE(rig.runToState("ArmSearch", 10.0)) << rig.state();
  ASSERT_TRUE(rig.runToState("SpraySteady")) << rig.state();
}

TEST(CheckPlace, WithoutTheOperatorThePlaceIsLeftOutInTheEnd) {
  FireRig rig({.burning_place = 1});
  rig.place_look.silent = true;
  ASSERT_TRUE(rig.runToState("PlaceRefused")) << rig.state();
  rig.place_look.silent = false;
  ASSERT_TRUE(rig.runToEnd());
  EXPECT_EQ(rig.state(), "Finished");
  EXPECT_EQ(rig.place(0).outcome, "not where it was configured");
  EXPECT_TRUE(rig.place(1).extinguished);
}

TEST(CheckPlace, TheOperatorMayGoOnInSpiteOfIt) {
  FireRig rig;
  rig.place_look.misplaced = {0.2, 0.0, 0.0};
  ASSERT_TRUE(rig.runToState("PlaceRefused")) << rig.state();
  EXPECT_EQ(rig.mission->continueDespite("place 2", "Ada", rig.clock.now()).error().code,
            ErrorCode::Refused);
  EXPECT_TRUE(rig.mission->continueDespite("place 1", "Ada", rig.clock.now()).has_value());
  rig.run(0.1);
  EXPECT_EQ(rig.state(), "ArmSearch");
}

TEST(NudgePlace, RefusesWhatIsNoNudgeAndWhileTheArmWorksThere) {
  FireRig rig;
  EXPECT_EQ(rig.mission->nudgePlace("place 9", {}).error().code, ErrorCode::InvalidInput);
  EXPECT_EQ(rig.mission->nudgePlace("place 1", {NAN, 0, 0}).error().code, ErrorCode::InvalidInput);
  EXPECT_EQ(rig.mission->nudgePlace("place 1", {1.2, 0, 0}).error().code, ErrorCode::Refused);
  EXPECT_EQ(rig.mission->nudgePlace("place 1", {0, 0, 0.6}).error().code, ErrorCode::Refused);
  ASSERT_TRUE(rig.runToState("ArmSearch"));
  EXPECT_EQ(rig.mission->nudgePlace("place 1", {0.1, 0, 0}).error().code, ErrorCode::Refused);
  EXPECT_TRUE(rig.mission->nudgePlace("place 2", {0.1, 0, 0}).has_value());
  rig.host->hold(HoldReason::OperatorPause, "look", rig.clock.now());
  EXPECT_TRUE(rig.mission->nudgePlace("place 1", {0.1, 0, 0}).has_value());
}

}  // namespace
}  // namespace kiln
