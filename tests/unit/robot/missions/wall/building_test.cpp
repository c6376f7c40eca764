#include <gtest/gtest.h>

#include "robot/missions/wall/wall_view.h"
#include "tests/unit/robot/missions/wall/wall_rig.h"

namespace kiln {
namespace {

constexpr std::size_t kAll = 11;

TEST(Building, BrickByBrickFromOneStandThenOnToTheNext) {
  WallRig rig(kAll);
  const auto& load = rig.context->load();
  ASSERT_GT(load.order.positions.size(), 1u);
  const std::size_t first = load.order.positions[0].slots.size();
  rig.force("TakeOutBrick");
  ASSERT_TRUE(rig.runTo([&] { return rig.context->belief.built.size() == first; })) << rig.why();
  EXPECT_EQ(rig.context->belief.taken_out, first);
  EXPECT_FALSE(rig.context->belief.held.has_value());
  EXPECT_EQ(rig.state(), "DriveToWall");
  EXPECT_TRUE(rig.runToState("LocateWall"));
  EXPECT_TRUE(rig.context->standsAt(rig.context->buildingPose()));
}

TEST(Building, TheSceneShowsWhatIsSetWhatHangsAndWhatIsStillCarried) {
  WallRig rig(kAll);
  const auto drawn = [&](const std::string& layer, ItemStyle style) {
    const auto items = wall::sceneItems(*rig.context);
    return std::count_if(items.begin(), items.end(), [&](const SceneItem& item) {
      return item.layer == layer && item.shape == SceneItem::Shape::Box && item.style == style;
    });
  };
  EXPECT_EQ(drawn("wall.carried", ItemStyle::Done), 11);
  EXPECT_EQ(drawn("wall.blueprint", ItemStyle::Target), 1);
  rig.force("TakeOutBrick");
  ASSERT_TRUE(rig.runTo([&] { return rig.context->belief.built.size() == 1; })) << rig.why();
  ASSERT_TRUE(rig.runToState("SetBrick"));
  EXPECT_EQ(drawn("wall.blueprint", ItemStyle::Done), 1);
  EXPECT_EQ(drawn("wall.carried", ItemStyle::Active), 1);
  EXPECT_EQ(drawn("wall.carried", ItemStyle::Done), 9);
}

TEST(Building, ABrickThatFallsOnTheWayIsMissedAndNothingIsSetInItsPlace) {
  WallRig rig(kAll);
  rig.force("TakeOutBrick");
  ASSERT_TRUE(rig.runToState("SetBrick"));
  rig.hangs = false;
  ASSERT_TRUE(rig.runToState("WallGivenUp")) << rig.state();
  EXPECT_NE(rig.why().find("lost"), std::string::npos) << rig.why();
  EXPECT_TRUE(rig.context->belief.built.empty());
  EXPECT_TRUE(rig.context->belief.unloading());
  rig.force("TakeOutBrick");
  EXPECT_TRUE(rig.runToState("WallGivenUp"));
}

TEST(Building, WhatWasLetGoIsCountedThoughTheArmMetSomethingWhenItLeft) {
  WallRig rig(kAll);
  rig.force("TakeOutBrick");
  ASSERT_TRUE(rig.runToState("SetBrick"));
  // Over its slot, before it, down, off what carries it, to its neighbour, back, down; then away.
  rig.motions.rule = [&](const ArmMoveTerms& terms) {
    const bool leaves = rig.gripper.on.none();
    const double n = terms.guard_force_n.value_or(1e3);
    return leaves || n <= rig.context->config.building.set.support_n ? "contact" : "";
  };
  ASSERT_TRUE(rig.runToState("TakeOutBrick")) << rig.state() << ": " << rig.why();
  EXPECT_EQ(rig.context->belief.built.size(), 1u);
  EXPECT_FALSE(rig.context->belief.held.has_value());
}

TEST(Building, WithoutTheMarkerNoneOfItsStatesBuilds) {
  for (const char* state : {"DriveToWall", "TakeOutBrick", "LocateWall"}) {
    WallRig rig(0);
    rig.force(state);
    EXPECT_TRUE(rig.runToState("DriveToMarker") || rig.state() == "WallGivenUp")
        << state << " went to " << rig.state();
    EXPECT_TRUE(rig.context->belief.built.empty());
  }
  WallRig rig(kAll);
  rig.context->belief.wall.reset();
  for (const char* state : {"DriveToWall", "TakeOutBrick", "LocateWall"}) {
    rig.force(state);
    EXPECT_TRUE(rig.runToState("DriveToMarker")) << state << " went to " << rig.state();
  }
}

TEST(Building, WhatIsNotInTheStorageIsNotTakenOut) {
  WallRig rig(2);  // the plan stores last what is built first
  ASSERT_FALSE(rig.context->inStorage(rig.context->nextOut().brick));
  rig.force("TakeOutBrick");
  ASSERT_TRUE(rig.runToState("WallGivenUp"));
  EXPECT_NE(rig.why().find("not in the storage"), std::string::npos) << rig.why();
  EXPECT_EQ(rig.storage.writes, 0);
}

/// What an interruption left standing in a bin, with the magnets on.
TEST(Building, NoCompartmentTravelsWhileABrickStandsInABin) {
  WallRig rig(kAll);
  rig.reachInto(rig.context->nextOut());
  rig.context->belief.held =
      HeldBrick{"brick 1", BrickKind::Red, X_brick_face({0, 0}, false).inverse(), 1.0};
  rig.context->belief.taken_out = 1;
  rig.motions.endings = {"never"};
  rig.gripper.on.set();
  rig.force("StoreBrick");
  EXPECT_FALSE(rig.runTo([&] { return rig.storage.writes > 0; }, 5.0));
  const Eigen::Isometry3d X_base_flange = rig.robot.X_base_flange(rig.arm.trueQ());
  const Eigen::Vector3d out = rig.motions.goals.back().translation() - X_base_flange.translation();
  EXPECT_GT(out.norm(), 0.1);
  const Eigen::Vector3d into =
      X_base_flange.linear() * rig.robot.X_flange_tool.pose().linear().col(2);
  EXPECT_LT(out.normalized().dot(into), -0.99) << "back from the plate";
  rig.motions.ending = "";  // it is out
  EXPECT_TRUE(rig.runTo([&] { return rig.storage.writes > 0; }, 30.0)) << rig.why();
}

/// Pause and teleoperation may end anywhere: what was gripped in a bin then is known to hang.
TEST(Building, WhatWasGrippedBeforeAPauseIsLedOutAndSet) {
  WallRig rig(kAll);
  rig.reachInto(rig.context->nextOut());
  rig.gripper.on.set();
  rig.force("TakeOutBrick");
  ASSERT_TRUE(rig.runToState("SetBrick"));
  EXPECT_EQ(rig.context->belief.taken_out, 1u);
  ASSERT_FALSE(rig.motions.under.empty());
  EXPECT_TRUE(rig.motions.under.back().carried.has_value());
  ASSERT_TRUE(rig.runTo([&] { return rig.context->belief.built.size() == 1; })) << rig.why();
}

}  // namespace
}  // namespace kiln
