#include "robot/perception/bricks/brick_sweep.h"

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/evaluation/bricks/brick_trial.h"
#include "robot/perception/bricks/surface_leaves.h"

namespace kiln {
namespace {

TEST(BrickSweep, PutsReturnsWhereTheLidarWasAtTheirTime) {
  PointCloud scan;
  scan.stamp = Stamp{} + fromSeconds(1.0);
  scan.push(1, 0, 0, 0, 0, 0.0F);
  scan.push(1, 0, 0, 0, 0, 0.08F);
  scan.push(std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0, 0.09F);
  PoseTrack track;
  track.push(scan.stamp, makePose({0, 0, 1}, {0, 0, 0}));
  track.push(scan.stamp + fromSeconds(0.08), makePose({0, 0.1, 1}, {0, 0, M_PI_2}));
  BrickSweep sweep;
  sweep.add(scan, track);
  ASSERT_EQ(sweep.size(), 2U);
  EXPECT_LT((sweep.points[0] - Eigen::Vector3f(1, 0, 1)).norm(), 1e-3F);
  EXPECT_LT((sweep.points[1] - Eigen::Vector3f(0, 1.1F, 1)).norm(), 1e-3F);
  EXPECT_LT((sweep.origins[1] - Eigen::Vector3f(0, 0.1F, 1)).norm(), 1e-3F);
}

TEST(BrickSweep, TakesPreparedReturnsAsTheyAre) {
  PointCloud scan;
  scan.stamp = Stamp{} + fromSeconds(1.0);
  scan.push(3, 2, 1, 0, 0, 0.0F);
  scan.push(3, 2, 1, 0, 0, 0.08F);
  PoseTrack track;
  track.push(scan.stamp, makePose({0, 0, 1}, {0, 0, 0}));
  track.push(scan.stamp + fromSeconds(0.08), makePose({0, 0.1, 1}, {0, 0, M_PI_2}));
  BrickSweep sweep, more;
  sweep.addPrepared(scan, track);
  more.add(sweep);
  more.add(sweep);
  ASSERT_EQ(more.size(), 4U);
  for (const Eigen::Vector3f& p : more.points) EXPECT_EQ(p, Eigen::Vector3f(3, 2, 1));
  EXPECT_LT((more.origins[2] - Eigen::Vector3f(0, 0, 1)).norm(), 1e-6F);
  EXPECT_LT((more.origins[3] - Eigen::Vector3f(0, 0.1F, 1)).norm(), 1e-3F);
}

TEST(PrepareSweep, FindsTheGroundOfALeaningBase) {
  const BrickTrial trial = makeTrial({}, 5);
  const auto prepared =
      prepareSweep(trial.sweep, RoughPoseEstimator::region(trial.target, 0.6), {});
  ASSERT_TRUE(prepared.has_value()) << prepared.error();
  const Eigen::Vector3d up = trial.X_world_base.linear().transpose().col(2);
  EXPECT_LT(std::acos(prepared->ground.n.dot(up)) / kDeg, 0.25);
  EXPECT_GT(prepared->surface.size(), 3000U);
  // Normals of upright faces and of tops: a few degrees of scatter.
  int known = 0, along_axes = 0;
  for (const SurfacePoint& point : prepared->surface) {
    EXPECT_GT(point.p.z(), 0.03F);
    if (point.n.isZero()) continue;
    ++known;
    const float z = std::abs(point.n.z());
    if (z > 0.9F || z < 0.44F) ++along_axes;
  }
  EXPECT_GT(known, static_cast<int>(prepared->surface.size()) * 8 / 10);
  EXPECT_GT(along_axes, known * 7 / 10);
}

TEST(PrepareSweep, SaysWhatIsMissing) {
  SweepRegion region;
  region.low = Eigen::Vector3d(1, -2, -0.3);
  region.high = Eigen::Vector3d(5, 2, 1.5);
  const auto nothing = prepareSweep({}, region, {});
  ASSERT_FALSE(nothing.has_value());
  EXPECT_EQ(nothing.error().code, ErrorCode::Degenerate);
  EXPECT_NE(nothing.error().message.find("no ground"), std::string::npos) << nothing.error();

  BrickSweep bare;  // ground alone
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) {
      bare.points.emplace_back(1.2F + 0.03F * static_cast<float>(i),
                               -1.5F + 0.03F * static_cast<float>(j), 0.0F);
      bare.origins.emplace_back(0.0F, 0.0F, 1.5F);
    }
  const auto ground = prepareSweep(bare, region, {});
  ASSERT_FALSE(ground.has_value());
  EXPECT_NE(ground.error().message.find("too few points on bricks"), std::string::npos)
      << ground.error();
}

TEST(FitGround, RefusesASlopeThatNoRobotStandsOn) {
  std::vector<Eigen::Vector3f> points;
  for (int i = -40; i < 40; ++i)
    for (int j = -40; j < 40; ++j) {
      const float x = 0.02F * static_cast<float>(i), y = 0.02F * static_cast<float>(j);
      points.emplace_back(x, y, 0.25F * x);  // 14 deg
    }
  const auto fit = fitGround(thin(points, 0.02), {});
  ASSERT_FALSE(fit.has_value());
  EXPECT_EQ(fit.error().code, ErrorCode::Degenerate);
}

}  // namespace
}  // namespace kiln
