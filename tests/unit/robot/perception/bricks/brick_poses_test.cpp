#include "robot/perception/bricks/brick_poses.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "common/geom/pose.h"
#include "robot/evaluation/bricks/brick_trial.h"
#include "robot/perception/bricks/brick_perception.h"
#include "tests/support/quantile.h"

namespace kiln {
namespace {

using test::quantile;

const BrickEstimate& estimateOf(const BrickPoses& poses, int id) {
  return *std::find_if(poses.bricks.begin(), poses.bricks.end(),
                       [id](const BrickEstimate& brick) { return brick.id == id; });
}

class BrickPosesOf : public testing::TestWithParam<TrialKind> {};

TEST_P(BrickPosesOf, AreRightToAboutACentimetre) {
  std::vector<double> position_m, yaw_deg;
  int seen = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    TrialOptions options;
    options.kind = GetParam();
    const BrickTrial trial = makeTrial(options, seed);
    const auto sight = BrickPerception({}).perceive(trial.sweep, trial.target);
    ASSERT_TRUE(sight.has_value()) << sight.error();
    for (const BrickOutcome& o : compare(trial, sight->bricks)) {
      if (o.evidence.expected < 40) continue;
      ++seen;
      if (o.confidence <= 0.7) continue;
      position_m.push_back(o.error_m);
      yaw_deg.push_back(o.yaw_error_deg);
      EXPECT_LT(o.error_m, 0.05) << "seed " << seed << " brick " << o.id;
    }
  }
  ASSERT_GT(seen, 10);
  EXPECT_GE(static_cast<int>(position_m.size()), seen * 7 / 10);
  EXPECT_LT(quantile(position_m, 0.5), 0.012);
  EXPECT_LT(quantile(yaw_deg, 0.5), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BrickPosesOf,
                         testing::Values(TrialKind::Pile, TrialKind::Lab, TrialKind::Wall));

/// The lab's pile, where every stack stands in front of the robot.
struct Lab {
  BrickScene scene;
  BrickTarget target;
  Eigen::Isometry3d X_world_base;
  int top_red = 3, top_blue = 10, lower_green = 5;  // ids: four red, four green, three blue

  explicit Lab(std::uint64_t seed) {
    SceneRandom random(seed);
    scene = makePileScene(true, random);
    target.bricks = scene.database;
    X_world_base = scene.X_world_target * makePose({1.1, -2.6, 0}, {0, 0, M_PI_2}) *
                   Eigen::Translation3d(-SweepSensor{}.ahead_m, 0, 0);
    target.X_base_target = X_world_base.inverse() * scene.X_world_target;
  }
  TrueBrick& brick(int id) {
    return *std::find_if(scene.bricks.begin(), scene.bricks.end(),
                         [id](const TrueBrick& b) { return b.id == id; });
  }
  [[nodiscard]] BrickPoses perceive() const {
    SceneRandom random(99);
    const BrickSweep sweep = SweepSynthesis({}, random).sweep(scene, X_world_base);
    auto sight = BrickPerception({}).perceive(sweep, target);
    EXPECT_TRUE(sight.has_value()) << sight.error();
    return sight ? sight->bricks : BrickPoses{};
  }
};

TEST(BrickPoses, ABrickThatIsGoneIsMissing) {
  Lab lab(1);
  std::erase_if(lab.scene.bricks, [&](const TrueBrick& b) { return b.id == lab.top_red; });
  const BrickPoses poses = lab.perceive();
  ASSERT_EQ(poses.bricks.size(), 11U);
  EXPECT_EQ(estimateOf(poses, lab.top_red).state, BrickState::Missing);
  EXPECT_EQ(estimateOf(poses, lab.top_red).confidence, 0.0);
  EXPECT_EQ(estimateOf(poses, lab.lower_green).state, BrickState::Found);
}

TEST(BrickPoses, ABrickThatLeansIsTilted) {
  Lab lab(2);
  TrueBrick& top = lab.brick(lab.top_blue);
  top.X_world_brick = top.X_world_brick * makePose({0, 0, 0.03}, {0.2, 0, 0});
  const BrickEstimate brick = estimateOf(lab.perceive(), lab.top_blue);
  EXPECT_EQ(brick.state, BrickState::Tilted);
  EXPECT_NEAR(brick.tilt_rad, 0.2, 0.06);
  EXPECT_LE(brick.confidence, 0.5);
}

TEST(BrickPoses, ABrickThatLiesBesideThePileHasFallen) {
  Lab lab(3);
  TrueBrick& top = lab.brick(lab.top_red);
  const Eigen::Isometry3d X_pile_brick = makePose({0.2, -0.6, 0.1}, {0, 0, 0.5});
  top.X_world_brick = lab.scene.X_world_target * X_pile_brick;
  const BrickEstimate brick = estimateOf(lab.perceive(), lab.top_red);
  EXPECT_EQ(brick.state, BrickState::Fallen);
  EXPECT_LE(brick.confidence, 0.5);
  const Eigen::Vector3d off = brick.X_base_brick.translation() -
                              (lab.X_world_base.inverse() * top.X_world_brick).translation();
  EXPECT_LT(off.norm(), 0.15);
}

TEST(BrickPoses, AnExcludedBrickStaysWhereItWasExpected) {
  Lab lab(4);
  lab.target.bricks[static_cast<std::size_t>(lab.top_blue)].excluded = true;
  const BrickPoses poses = lab.perceive();
  EXPECT_EQ(estimateOf(poses, lab.top_blue).state, BrickState::Excluded);
  EXPECT_EQ(estimateOf(poses, lab.top_red).state, BrickState::Found);
}

TEST(BrickPoses, ABrickOutOfSightIsUnseen) {
  Lab lab(5);
  // One more, behind the stack of blue ones, lower than it and away from the gaps beside it.
  lab.target.bricks.push_back({50, BrickKind::Red, makePose({1.8, 0.35, 0.1}, {0, 0, 0}), false});
  const BrickEstimate brick = estimateOf(lab.perceive(), 50);
  EXPECT_EQ(brick.state, BrickState::Unseen);
  EXPECT_EQ(brick.confidence, 0.0);
}

TEST(BrickPoses, NothingInSightIsAnError) {
  PreparedSweep sweep;
  sweep.p_level_sensor = {0, 0, 1.5};
  BrickTarget target;
  target.bricks.push_back({0, BrickKind::Red, makePose({3, 0, 0.1}, {0, 0, 0}), true});
  const auto poses = BrickPoseEstimator({}).estimate(sweep, target, Eigen::Isometry3d::Identity());
  ASSERT_FALSE(poses.has_value());
  EXPECT_EQ(poses.error().code, ErrorCode::Degenerate);
}

TEST(BrickPoses, TheSameSweepGivesTheSameAnswer) {
  const BrickTrial trial = makeTrial({}, 8);
  const auto a = BrickPerception({}).perceive(trial.sweep, trial.target);
  const auto b = BrickPerception({}).perceive(trial.sweep, trial.target);
  ASSERT_TRUE(a.has_value() && b.has_value());
  for (std::size_t i = 0; i < a->bricks.bricks.size(); ++i)
    EXPECT_TRUE(a->bricks.bricks[i].X_base_brick.isApprox(b->bricks.bricks[i].X_base_brick, 0.0));
}

TEST(BrickPerceptionConfig, RoundTripsAndRefusesWhatIsOutOfRange) {
  BrickPerception::Config config;
  config.bricks.outline_weight = 7.0;
  BrickPerception::Config read;
  ASSERT_TRUE(loadYamlText(dumpConfig(config), "test",
                           ConfigNode{[&read](ConfigArchive& a) { read.visit(a); }})
                  .has_value());
  EXPECT_EQ(read.bricks.outline_weight, 7.0);
  EXPECT_FALSE(overrideConfig("bricks.max_iterations=0", read).has_value());
}

}  // namespace
}  // namespace kiln
