#include "robot/perception/bricks/sweep_visibility.h"

#include <numeric>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/evaluation/bricks/sweep_synthesis.h"

namespace kiln {
namespace {

/// As SweepSynthesis moves its LiDAR.
PlannedSweep planned(const SweepSensor& sensor, int instants) {
  PlannedSweep out{{}, sensor.sweep_s};
  for (int k = 0; k < instants; ++k) {
    const double tilt =
        sensor.tilt_from_deg + (sensor.tilt_to_deg - sensor.tilt_from_deg) * k / (instants - 1);
    out.X_world_lidar.push_back(
        makePose({sensor.ahead_m, 0, sensor.height_m - sensor.lever_m}, {0, tilt * kDeg, 0}) *
        Eigen::Translation3d(0, 0, sensor.lever_m));
  }
  return out;
}

SweepSensor exactSensor() {
  SweepSensor sensor;
  sensor.bias_sigma_m = sensor.noise_sigma_m = sensor.dropout = 0.0;
  sensor.mount_sigma_m = sensor.mount_sigma_deg = 0.0;
  return sensor;
}

/// The returns that a sweep truly gives are those that were expected, brick by brick.
TEST(SweepVisibility, ExpectsTheReturnsThatComeBack) {
  SceneRandom random(3);
  BrickScene scene;
  std::vector<ModelBrick> bricks;
  for (const double y : {-0.6, 0.0, 0.7})
    for (int layer = 0; layer < 3; ++layer) {
      TrueBrick brick;
      brick.id = static_cast<int>(bricks.size());
      brick.kind = y > 0.5 ? BrickKind::Green : BrickKind::Red;
      brick.size_m = brickSize(brick.kind);
      brick.X_world_brick =
          makePose({3.2 + 0.3 * y, y, 0.1 + 0.2 * layer}, {0, 0, M_PI_2 + 0.4 * y});
      scene.bricks.push_back(brick);
      bricks.push_back({brick.id, brick.kind, brick.X_world_brick});
    }
  const SweepSensor sensor = exactSensor();
  const BrickSweep sweep =
      SweepSynthesis(sensor, random).sweep(scene, Eigen::Isometry3d::Identity());
  double came = 0.0;
  for (const Eigen::Vector3f& p : sweep.points) came += p.z() > 0.004F ? 1.0 : 0.0;
  SweepVisibility visibility({}, bricks);
  const std::vector<float> returns = visibility.returnsOf(planned(sensor, 41));
  const double expected = std::accumulate(returns.begin(), returns.end(), 0.0);
  EXPECT_GT(came, 5000.0);
  EXPECT_NEAR(expected / came, 1.0, 0.08) << expected << " expected, " << came << " came";
}

TEST(SweepVisibility, WhatIsHiddenOrOutOfTheTiltGivesNothing) {
  const std::vector<ModelBrick> bricks{
      {0, BrickKind::Blue, makePose({3.0, 0, 0.1}, {0, 0, M_PI_2})},
      {1, BrickKind::Red, makePose({3.6, 0, 0.1}, {0, 0, M_PI_2})}};
  SweepSensor sensor = exactSensor();
  sensor.height_m = 0.25;
  SweepVisibility visibility({}, bricks);
  const auto cells = visibility.cellsFound(visibility.returnsOf(planned(sensor, 9)));
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_GT(cells[0], cellsNeeded({}));
  EXPECT_LT(cells[1], 20.0) << "behind the blue one";
  // Level and upwards its lowest laser passes over both.
  sensor.height_m = 1.6;
  sensor.tilt_from_deg = -40.0;
  sensor.tilt_to_deg = -2.0;
  for (const double found : visibility.cellsFound(visibility.returnsOf(planned(sensor, 9))))
    EXPECT_EQ(found, 0.0);
}

TEST(SweepVisibility, TwoSweepsFindMoreButNoMoreThanThereIs) {
  const std::vector<ModelBrick> bricks{
      {0, BrickKind::Red, makePose({3.0, 0, 0.1}, {0, 0, M_PI_2})}};
  const SweepSensor sensor = exactSensor();
  SweepVisibility visibility({}, bricks);
  PlannedSweep sweep = planned(sensor, 9);
  sweep.duration_s = 0.1;
  std::vector<float> returns = visibility.returnsOf(sweep);
  const double once = visibility.cellsFound(returns)[0];
  for (float& r : returns) r *= 2.0F;
  const double twice = visibility.cellsFound(returns)[0];
  for (float& r : returns) r *= 1000.0F;
  const double always = visibility.cellsFound(returns)[0];
  EXPECT_GT(once, 0.0);
  EXPECT_GT(twice, once);
  EXPECT_LT(twice, 2.0 * once);
  // Front and top of 0.3 x 0.2 m, in cells of 2 cm.
  EXPECT_NEAR(always, 300.0, 1.0);
}

}  // namespace
}  // namespace kiln
