#include "robot/evaluation/bricks/brick_scene.h"

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/evaluation/bricks/sweep_synthesis.h"

namespace kiln {
namespace {

/// Bounds of scenario.md section 4: a stack 5 cm along both axes, a brick on it 1 cm: 8.5 cm at most.
TEST(BrickScene, PileIsOffByWhatThePageAllows) {
  SceneRandom random(1);
  const BrickScene scene = makePileScene(false, random);
  ASSERT_EQ(scene.bricks.size(), 45U);
  double largest_m = 0.0, largest_deg = 0.0;
  for (const TrueBrick& brick : scene.bricks) {
    const TargetBrick& nominal = scene.database[static_cast<std::size_t>(brick.id)];
    const Eigen::Isometry3d off =
        nominal.X_target_brick.inverse() * scene.X_world_target.inverse() * brick.X_world_brick;
    largest_m = std::max(largest_m, off.translation().head<2>().norm());
    largest_deg = std::max(largest_deg, rotationAngle(off) / kDeg);
    EXPECT_LT(std::abs(off.translation().z()), 0.011);  // five bricks of 2 mm at most, half of one
    for (int k = 0; k < 3; ++k)
      EXPECT_LE(std::abs(brick.size_m[k] - brickSize(brick.kind)[k]), 0.002 + 1e-12);
  }
  EXPECT_LT(largest_m, 0.085);
  EXPECT_GT(largest_m, 0.03);
  EXPECT_LT(largest_deg, 11.5 + 1e-6);
  EXPECT_GT(largest_deg, 4.0);
}

TEST(BrickScene, WallHasItsBricksFromTheGroundUp) {
  SceneRandom random(2);
  const BrickScene scene = makeWallScene(20, random);
  ASSERT_EQ(scene.bricks.size(), 20U);
  for (std::size_t i = 1; i < scene.bricks.size(); ++i)
    EXPECT_GT(scene.bricks[i].X_world_brick.translation().z(),
              scene.bricks[i - 1].X_world_brick.translation().z() - 0.02);
}

TEST(BrickScene, OnlyBricksOnWhichNothingLiesAreDisturbed) {
  SceneRandom random(3);
  BrickScene scene = makePileScene(false, random);
  const BrickScene before = scene;
  disturb(scene, 1.0, random);
  int disturbed = 0;
  for (std::size_t i = 0; i < scene.fates.size(); ++i) {
    if (scene.fates[i] == BrickFate::InPlace) continue;
    ++disturbed;
    EXPECT_GT(before.bricks[i].X_world_brick.translation().z(), 0.88);  // the fifth layer
    const TrueBrick* const brick = scene.find(static_cast<int>(i));
    EXPECT_EQ(brick == nullptr, scene.fates[i] == BrickFate::Missing);
    if (brick == nullptr) continue;
    const double lean = std::acos(std::min(1.0, brick->X_world_brick.linear()(2, 2))) / kDeg;
    if (scene.fates[i] == BrickFate::Tilted) {
      EXPECT_GT(lean, 7.9);
    } else {
      EXPECT_LT(lean, 0.1);
      EXPECT_NEAR(brick->X_world_brick.translation().z(), 0.1, 0.003);  // on the ground
    }
  }
  EXPECT_EQ(disturbed, 9);  // one a stack
}

/// White noise, bias by laser and drop-outs of scenario.md section 2, seen on bare ground: of one
/// laser the mean is its bias and the scatter the noise; over the lasers both.
TEST(SweepSynthesis, HasTheNoiseOfThePage) {
  SceneRandom random(4);
  SweepSensor sensor;
  sensor.mount_sigma_m = sensor.mount_sigma_deg = 0.0;
  sensor.sweep_s = 1.0;
  const BrickSweep sweep =
      SweepSynthesis(sensor, random).sweep(BrickScene{}, Eigen::Isometry3d::Identity());
  ASSERT_GT(sweep.size(), 20000U);
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const Eigen::Vector3f d = sweep.points[i] - sweep.origins[i];
    const float range = d.norm(), truth = -sweep.origins[i].z() / (d.z() / range);
    if (truth > 8.0F) continue;
    const double off = static_cast<double>(range - truth);
    sum += off;
    squares += off * off;
    count += 1.0;
  }
  const double mean = sum / count, sigma = std::sqrt(squares / count - mean * mean);
  EXPECT_LT(std::abs(mean), 0.012);  // mean of the biases that look down
  EXPECT_GT(sigma, 0.0098);
  EXPECT_LT(sigma, 0.022);
}

TEST(SweepSynthesis, EdgesMixPixels) {
  SceneRandom random(5);
  SweepSensor sensor;
  sensor.bias_sigma_m = sensor.noise_sigma_m = 0.0;
  sensor.mount_sigma_m = sensor.mount_sigma_deg = 0.0;
  BrickScene scene;
  TrueBrick brick;
  brick.size_m = brickSize(BrickKind::Red);
  brick.X_world_brick = makePose({3.0, 0.0, 0.5}, {0, 0, M_PI_2});
  scene.bricks.push_back(brick);
  const std::vector<ClutterBox> wall{{makePose({3.5, 0, 1}, {0, 0, 0}), {0.1, 8, 2}}};
  const BrickSweep sweep =
      SweepSynthesis(sensor, random).sweep(scene, Eigen::Isometry3d::Identity(), wall);
  int between = 0;  // neither on the brick's front nor on the wall 0.55 m behind it
  for (const Eigen::Vector3f& p : sweep.points)
    if (p.x() > 3.12F && p.x() < 3.4F && std::abs(p.y()) < 0.2F && p.z() > 0.35F && p.z() < 0.55F)
      ++between;
  EXPECT_GT(between, 20);
}

}  // namespace
}  // namespace kiln
