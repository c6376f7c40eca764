#include "robot/missions/wall/wall_belief.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace kiln {
namespace {

WallBelief known() {
  WallBelief belief;
  belief.pile = FoundFrame{{1.0, 2.0, 0.3}, Eigen::Vector3d(0.01, 0.02, 0.001).asDiagonal()};
  PileBrick brick{BrickKind::Blue, BrickState::Found, Eigen::Isometry3d::Identity(), 0.9};
  brick.X_map_brick =
      Eigen::Translation3d(1.0, 2.0, 0.5) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
  brick.taken = true;
  brick.along_m = 0.007;
  belief.bricks = {brick};
  belief.stored = 3;
  belief.held = HeldBrick{"brick 4", BrickKind::Red, brick.X_map_brick, 0.98};
  belief.pile_looks = 2;
  belief.marker_looks = 1;
  return belief;
}

TEST(WallBelief, ComesBackAsItWasSaved) {
  const auto back = wallBeliefFromJson(wallBeliefToJson(known()));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_DOUBLE_EQ(back->pile->X_map_frame.y_m, 2.0);
  EXPECT_DOUBLE_EQ(back->pile->covariance(1, 1), 0.02);
  EXPECT_FALSE(back->wall.has_value());
  ASSERT_EQ(back->bricks.size(), 1u);
  EXPECT_EQ(back->bricks[0].kind, BrickKind::Blue);
  EXPECT_EQ(back->bricks[0].state, BrickState::Found);
  EXPECT_TRUE(back->bricks[0].X_map_brick.isApprox(known().bricks[0].X_map_brick, 1e-12));
  EXPECT_DOUBLE_EQ(back->bricks[0].confidence, 0.9);
  EXPECT_TRUE(back->bricks[0].taken);
  EXPECT_DOUBLE_EQ(back->bricks[0].along_m, 0.007);
  EXPECT_EQ(back->stored, 3u);
  ASSERT_TRUE(back->held.has_value());
  EXPECT_EQ(back->held->name, "brick 4");
  EXPECT_TRUE(back->held->X_tool_brick.isApprox(known().held->X_tool_brick, 1e-12));
  EXPECT_EQ(back->pile_looks, 2);
  EXPECT_EQ(back->marker_looks, 1);
}

TEST(WallBelief, WhatWasBuiltComesBackWithWhatHangs) {
  WallBelief belief = known();
  belief.stored = 3;
  belief.taken_out = 2;
  belief.built = {belief.bricks[0].X_map_brick};
  const auto back = wallBeliefFromJson(wallBeliefToJson(belief));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(back->taken_out, 2u);
  ASSERT_EQ(back->built.size(), 1u);
  EXPECT_TRUE(back->built[0].isApprox(belief.built[0], 1e-12));
  EXPECT_TRUE(back->unloading());
  belief.held.reset();  // it fell on the way
  const auto lost = wallBeliefFromJson(wallBeliefToJson(belief));
  ASSERT_TRUE(lost.has_value()) << lost.error();
  EXPECT_TRUE(lost->unloading());
}

TEST(WallBelief, MoreCannotBeBuiltThanWasTakenOutOrTakenOutThanWasStored) {
  WallBelief good = known();
  good.stored = 3;
  good.taken_out = 2;
  good.built = {Eigen::Isometry3d::Identity()};
  WallBelief more_out = good, more_built = good, two_gone = good;
  more_out.taken_out = 4;
  more_built.built.resize(3, Eigen::Isometry3d::Identity());
  two_gone.built.clear();
  for (const WallBelief& bad : {more_out, more_built, two_gone}) {
    const auto back = wallBeliefFromJson(wallBeliefToJson(bad));
    ASSERT_FALSE(back.has_value());
    EXPECT_NE(back.error().message.find("taken out"), std::string::npos) << back.error();
  }
  nlohmann::json damaged = wallBeliefToJson(good);
  damaged["built"][0]["wxyz"] = {0.0, 0.0, 0.0, 0.0};
  EXPECT_FALSE(wallBeliefFromJson(damaged).has_value());
}

TEST(WallBelief, WhatIsDamagedIsRefusedByName) {
  const nlohmann::json good = wallBeliefToJson(known());
  const auto refused = [](const nlohmann::json& saved) {
    const auto belief = wallBeliefFromJson(saved);
    return belief ? std::string() : belief.error().message;
  };
  nlohmann::json far = good, none = good, nan = good, looks = good, shape = good, kind = good,
                 state = good, turn = good, sure = good, held = good;
  far["pile"]["x_m"] = 1e9;
  none.erase("wall");
  nan["pile"]["covariance"][4] = nullptr;
  looks["pile_looks"] = -1;
  shape["pile"]["covariance"] = {1.0, 2.0};
  kind["bricks"][0]["kind"] = "pink";
  state["bricks"][0]["state"] = "gone";
  turn["bricks"][0]["pose"]["wxyz"] = {0.0, 0.0, 0.0, 0.0};
  sure["bricks"][0]["confidence"] = 1.5;
  held["held"]["in_tool"]["xyz_m"][1] = nullptr;
  for (const auto& bad : {kind, state, turn, sure, held}) EXPECT_NE(refused(bad), "") << bad;
  EXPECT_NE(refused(far).find("pile"), std::string::npos);
  EXPECT_NE(refused(none).find("wall"), std::string::npos);
  EXPECT_NE(refused(nan), "");
  EXPECT_NE(refused(looks).find("pile_looks"), std::string::npos);
  EXPECT_NE(refused(shape), "");
}

}  // namespace
}  // namespace kiln
