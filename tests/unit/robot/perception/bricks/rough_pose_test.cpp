#include "robot/perception/bricks/rough_pose.h"

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/evaluation/bricks/brick_trial.h"

namespace kiln {
namespace {

class RoughPoseOf : public testing::TestWithParam<std::tuple<TrialKind, int>> {};

/// Stacks are off by up to 5 cm and 10 deg each: what "the" pose of a pile is, is known to the
/// mean of that.
TEST_P(RoughPoseOf, IsRightToTheScatterOfItsStacks) {
  TrialOptions options;
  options.kind = std::get<0>(GetParam());
  const BrickTrial trial = makeTrial(options, static_cast<std::uint64_t>(std::get<1>(GetParam())));
  const auto prepared =
      prepareSweep(trial.sweep, RoughPoseEstimator::region(trial.target, 0.6), {});
  ASSERT_TRUE(prepared.has_value()) << prepared.error();
  const auto pose = RoughPoseEstimator({}).estimate(*prepared, trial.target);
  ASSERT_TRUE(pose.has_value()) << pose.error();
  const TargetError error = compareTarget(trial, pose->X_base_target);
  EXPECT_LT(error.position_m, 0.15);
  EXPECT_LT(error.yaw_deg, 3.0);
  EXPECT_GT(pose->overlap, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RoughPoseOf,
                         testing::Combine(testing::Values(TrialKind::Pile, TrialKind::Lab,
                                                          TrialKind::Wall),
                                          testing::Values(11, 12)));

TEST(RoughPose, RefusesWhatIsNotTheTarget) {
  const BrickTrial trial = makeTrial({}, 21);
  BrickTarget other = trial.target;
  // A single row along Y where the pile's front line runs along X.
  other.bricks.clear();
  for (int i = 0; i < 4; ++i)
    other.bricks.push_back(
        {i, BrickKind::Orange, makePose({2.0 + 0.2 * i, -0.4, 0.1 + 0.2 * i}, {0, 0, M_PI_2})});
  const auto prepared =
      prepareSweep(trial.sweep, RoughPoseEstimator::region(trial.target, 0.6), {});
  ASSERT_TRUE(prepared.has_value()) << prepared.error();
  const auto pose = RoughPoseEstimator({}).estimate(*prepared, other);
  ASSERT_FALSE(pose.has_value()) << pose->overlap;
  EXPECT_EQ(pose.error().code, ErrorCode::Degenerate);
}

TEST(RoughPose, RefusesAnEmptyTargetAndAPriorThatIsNoPose) {
  PreparedSweep sweep;
  EXPECT_EQ(RoughPoseEstimator({}).estimate(sweep, {}).error().code, ErrorCode::InvalidInput);
  BrickTarget target;
  target.bricks.push_back({});
  target.X_base_target.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(RoughPoseEstimator({}).estimate(sweep, target).error().code, ErrorCode::InvalidInput);
}

TEST(RoughPose, TheMarkersDirectionDecidesWhereTheBricksSayLittle) {
  // One red brick's front: 0.3 m wide, so its yaw is poorly seen.
  TrialOptions options;
  options.kind = TrialKind::Wall;
  const BrickTrial trial = makeTrial(options, 31);
  BrickTarget target = trial.target;
  const auto prepared = prepareSweep(trial.sweep, RoughPoseEstimator::region(target, 0.6), {});
  ASSERT_TRUE(prepared.has_value()) << prepared.error();
  RoughPoseEstimator::Config config;
  config.direction_weight = 1e4;
  const Eigen::Isometry3d X_true = trial.X_world_base.inverse() * trial.scene.X_world_target;
  const double wrong = 3.0 * kDeg;  // a marker's direction that is off must pull visibly
  target.front_line = X_true.linear() * Eigen::Vector3d(std::cos(wrong), std::sin(wrong), 0);
  const auto pulled = RoughPoseEstimator(config).estimate(*prepared, target);
  const auto free = RoughPoseEstimator(config).estimate(*prepared, trial.target);
  ASSERT_TRUE(pulled.has_value()) << pulled.error();
  ASSERT_TRUE(free.has_value()) << free.error();
  const auto yaw = [&](const RoughPose& pose) {
    const Eigen::Vector3d x = X_true.linear().transpose() * pose.X_base_target.linear().col(0);
    return std::atan2(x.y(), x.x()) / kDeg;
  };
  EXPECT_GT(yaw(*pulled), yaw(*free) + 0.5);
  EXPECT_LT(yaw(*pulled), 3.5);
}

}  // namespace
}  // namespace kiln
