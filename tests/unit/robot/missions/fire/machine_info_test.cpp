#include <set>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/wire/fire/fire_view.h"
#include "tests/unit/robot/missions/fire/fire_rig.h"

namespace kiln {
namespace {

TEST(FireMachine, DescribesEveryStateAndEdgeForTheOperator) {
  FireRig rig;
  const FsmInfo info = rig.mission->machine().info();
  EXPECT_EQ(info.mission, "fire");
  EXPECT_EQ(info.start_state, "EnterBuilding");
  std::set<std::string> groups;
  for (const FsmStateInfo& state : info.states) {
    groups.insert(state.group);
    EXPECT_FALSE(state.doc.empty()) << state.name;
    EXPECT_EQ(state.enterable, state.not_enterable_reason.empty()) << state.name;
  }
  EXPECT_EQ(groups, (std::set<std::string>{"search fire", "extinguish", "faults"}));
  for (const FsmEdgeInfo& edge : info.edges)
    EXPECT_FALSE(edge.consequence.empty()) << edge.from << edge.to;
}

TEST(FireMachine, EveryWorkingStateReactsToProtectiveStopAndClock) {
  FireRig rig;
  const FsmInfo info = rig.mission->machine().info();
  for (const FsmStateInfo& state : info.states) {
    if (state.terminal || state.name == "ProtectiveStop" || state.name == "TimeNearlyOver")
      continue;
    std::set<std::string> targets;
    for (const FsmEdgeInfo& edge : info.edges)
      if (edge.from == state.name) targets.insert(edge.to);
    EXPECT_TRUE(targets.count("ProtectiveStop") == 1 && targets.count("TimeNearlyOver") == 1)
        << state.name;
  }
}

TEST(FireMission, TellsPlacesEstimatesAndJet) {
  FireRig rig;
  ASSERT_TRUE(rig.runToState("SpraySteady"));
  rig.run(1.0);
  const FireSite site = rig.mission->site(rig.clock.now());
  ASSERT_EQ(site.places.size(), 2u);
  EXPECT_EQ(site.places[0].name, "place 1");
  ASSERT_EQ(site.fires.size(), 1u);
  EXPECT_EQ(site.fires[0].place, "place 1");
  EXPECT_TRUE(site.spraying);
  Scene scene;
  rig.mission->describe(scene, rig.clock.now());
  EXPECT_EQ(scene.items.size(), fire::sceneItems(site).size());
  EXPECT_EQ(scene.detail.schema, fire::kSiteSchema);
  ASSERT_GT(site.jet_map.size(), 10u);
  double nearest = 1.0;
  for (const Eigen::Vector3d& p : site.jet_map)
    nearest = std::min(nearest, (p - rig.sweep.p_plate_map).norm());
  EXPECT_LT(nearest, 0.04) << "5 cm between points";
}

TEST(FireMission, ScoresTheFirstLitreOnAPlace) {
  FireRig rig;
  const auto score = [&rig] {
    const auto figures = rig.mission->figures(rig.clock.now());
    return findFigure(figures, "score")->value;
  };
  EXPECT_EQ(score(), 0.0);
  rig.mission->belief().places[1].litres_est = 0.5;
  EXPECT_NEAR(score(), 3.0, 1e-9);
  rig.mission->belief().places[1].litres_est = 4.0;
  EXPECT_NEAR(score(), 6.0, 1e-9);
}

TEST(FireMission, RaisesAPlaceThatIsRefused) {
  FireRig rig;
  rig.place_look.misplaced = {0.2, 0.1, 0.0};
  EXPECT_TRUE(rig.mission->alarms(rig.clock.now()).empty());
  ASSERT_TRUE(rig.runToState("PlaceRefused")) << rig.state();
  ASSERT_EQ(rig.mission->alarms(rig.clock.now()).size(), 1u);
  EXPECT_EQ(rig.mission->alarms(rig.clock.now())[0].id, "place.refused");
}

TEST(FireMission, ItsCommandsAreThoseThatItDescribes) {
  FireRig rig;
  const MissionInfo info = rig.mission->info();
  ASSERT_NE(info.command(fire::kNudgePlace), nullptr);
  const MissionCommand nudge{fire::kNudgePlace, "place 2", {{"x", 0.1}, {"y", -0.2}, {"yaw", 3}}};
  ASSERT_EQ(info.command(fire::kNudgePlace)->arguments.size(), nudge.arguments.size());
  ASSERT_TRUE(rig.mission->command(nudge, "Ada", rig.clock.now()).has_value());
  const Pose2 by = rig.mission->site(rig.clock.now()).places[1].nudge;
  EXPECT_NEAR(by.x_m, 0.1, 1e-12);
  EXPECT_NEAR(by.y_m, -0.2, 1e-12);
  EXPECT_NEAR(by.yaw_rad, 3.0 * kDeg, 1e-12);
  const MissionCommand go_on{fire::kContinueDespite, "place 1", {}};
  EXPECT_EQ(rig.mission->command(go_on, "Ada", rig.clock.now()).error().code, ErrorCode::Refused)
      << "nothing objects";
}

TEST(FireMission, RefusesCommandsOfOtherMissions) {
  FireRig rig;
  EXPECT_EQ(rig.mission->command({"dance", "", {}}, "Ada", rig.clock.now()).error().code,
            ErrorCode::Refused);
}

}  // namespace
}  // namespace kiln
