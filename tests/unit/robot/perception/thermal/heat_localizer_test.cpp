#include "robot/perception/thermal/heat_localizer.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "robot/perception/thermal/heat_detector.h"
#include "tests/support/heat_sweep.h"
#include "tests/support/quantile.h"

namespace kiln {
namespace {

using testing::HeatSweep;

using test::quantile;

TEST(HeatLocalizer, MeetsItsGoalsOverManySeeds) {
  std::vector<double> range, lateral, baseline;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto error = HeatSweep(seed).run({});
    ASSERT_TRUE(error.has_value()) << "seed " << seed;
    range.push_back(error->range_m);
    lateral.push_back(error->lateral_m);
    baseline.push_back(error->baseline_m);
    EXPECT_LT(error->mahalanobis, 4.5) << "covariance is too sure of itself, seed " << seed;
  }
  std::printf(
      "range median %.1f mm p95 %.1f mm, lateral median %.1f mm p95 %.1f mm, bounding box median "
      "%.1f mm p95 %.1f mm\n",
      1e3 * quantile(range, 0.5), 1e3 * quantile(range, 0.95), 1e3 * quantile(lateral, 0.5),
      1e3 * quantile(lateral, 0.95), 1e3 * quantile(baseline, 0.5), 1e3 * quantile(baseline, 0.95));
  EXPECT_LE(quantile(range, 0.5), 0.03);  // goals of the evaluation `fire`
  EXPECT_LE(quantile(range, 0.95), 0.08);
  EXPECT_LE(quantile(lateral, 0.5), 0.015);
  EXPECT_LE(quantile(lateral, 0.95), 0.03);
}

TEST(HeatLocalizer, PanningOnTheSpotLeavesTheSizeAsDistance) {
  HeatSweep::Config config;
  config.moving = false;
  std::vector<double> range;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto error = HeatSweep(seed, config).run({});
    ASSERT_TRUE(error.has_value()) << "seed " << seed;
    range.push_back(error->range_m);
    EXPECT_LT(error->mahalanobis, 4.5) << seed;
  }
  EXPECT_LE(quantile(range, 0.5), 0.03);
  EXPECT_LE(quantile(range, 1.0), 0.08);
}

TEST(HeatLocalizer, ExactCamerasGiveMillimetres) {
  HeatSweep::Config config;
  config.extrinsic_m = config.extrinsic_deg = config.pose_m = config.pose_deg = 0;
  config.box_yaw_deg = config.off_centre_m = 0;
  const auto error = HeatSweep(3, config).run({});
  ASSERT_TRUE(error.has_value());
  EXPECT_LT(error->range_m, 0.006);
  EXPECT_LT(error->lateral_m, 0.002);
}

TEST(HeatLocalizer, ASecondHotThingDoesNotPullTheEstimate) {
  HeatSweep::Config config;
  config.decoy = true;  // as hot as the plate, seen in every third picture only
  const auto error = HeatSweep(5, config).run({});
  ASSERT_TRUE(error.has_value());
  EXPECT_LT(error->range_m, 0.08);
  EXPECT_LT(error->lateral_m, 0.03);
}

TEST(HeatLocalizer, NeedsEnoughViews) {
  HeatSweep::Config config;
  config.views = 4;
  EXPECT_FALSE(HeatSweep(1, config).run({}).has_value());
}

TEST(HeatLocalizer, BeginForgetsAndBadPosesAreIgnored) {
  HeatLocalizer localizer({});
  HeatDetections detections;
  HeatBlob blob;
  blob.u = 80;
  blob.v = 60;
  blob.u_min = blob.v_min = 40;
  blob.u_max = blob.v_max = 90;
  blob.half_max_area_px = 470;
  detections.blobs = {blob};
  const Eigen::Isometry3d X = testing::lookAt({0.9, 0, 0}, {0, 0, 0});
  for (int i = 0; i < 10; ++i) localizer.add(detections, X, {1, 0, 0});
  EXPECT_TRUE(localizer.estimate().has_value());
  localizer.begin();
  EXPECT_FALSE(localizer.estimate().has_value());
  Eigen::Isometry3d broken = X;
  broken.translation().x() = std::nan("");
  detections.usable = true;
  for (int i = 0; i < 10; ++i) localizer.add(detections, broken, {1, 0, 0});
  for (int i = 0; i < 10; ++i) localizer.add(detections, X, {0, 0, 1});
  detections.usable = false;
  for (int i = 0; i < 10; ++i) localizer.add(detections, X, {1, 0, 0});
  EXPECT_FALSE(localizer.estimate().has_value());
}

}  // namespace
}  // namespace kiln
