#include "robot/missions/fire/skills/warming_trend.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

constexpr double kRate_hz = 8.77;
const Eigen::Vector3d kPlace(0, 0, 1);  // one metre before a camera at the origin: pixel 79.5, 59.5

/// A warm blob in an image each 1 / 8.77 s, its peak off by 50 mK.
class WarmingTrendTest : public testing::Test {
 protected:
  WarmingTrendTest() { trend.begin(kPlace); }
  template <class PeakAt>
  void watch(double seconds, PeakAt peak_at, double off_px = 5.0) {
    std::normal_distribution<double> noise(0.0, 0.05);
    for (double t = 0.0; t < seconds; t += 1.0 / kRate_hz) {
      HeatDetections image;
      image.stamp = Stamp{} + fromSeconds(t);
      HeatBlob& blob = image.blobs.emplace_back();
      blob.rejection = HeatRejection::TooCool;
      blob.u = 79.5 + off_px;
      blob.v = 59.5;
      blob.peak_k = peak_at(t) + noise(random);
      trend.add(image, Eigen::Isometry3d::Identity());
    }
  }
  std::mt19937_64 random{1};
  WarmingTrend trend{{}};
};

TEST_F(WarmingTrendTest, TellsARiseFromNoise) {
  watch(8.0, [](double t) { return 330.0 + 0.5 * t; });
  ASSERT_TRUE(trend.rise().has_value());
  EXPECT_NEAR(*trend.rise(), 0.5, 0.02);
}

TEST_F(WarmingTrendTest, WhatIsMerelyWarmDoesNotRise) {
  watch(8.0, [](double) { return 330.0; });
  EXPECT_FALSE(trend.rise().has_value());
  trend.begin(kPlace);
  watch(8.0, [](double t) { return 330.0 - 0.5 * t; });
  EXPECT_FALSE(trend.rise().has_value());
}

TEST_F(WarmingTrendTest, AFlickerIsNoRise) {
  watch(4.0, [](double t) { return 330.0 + 6.0 * std::sin(7.0 * t) + 0.2 * t; });
  EXPECT_FALSE(trend.rise().has_value());
}

TEST_F(WarmingTrendTest, WhatIsWarmElsewhereSaysNothingOfThePlace) {
  watch(
      8.0, [](double t) { return 330.0 + 0.5 * t; }, 40.0);
  EXPECT_FALSE(trend.rise().has_value());
}

TEST_F(WarmingTrendTest, AFewViewsSayNothingAndBeginForgets) {
  watch(0.7, [](double t) { return 330.0 + 0.5 * t; });
  EXPECT_FALSE(trend.rise().has_value());
  watch(8.0, [](double t) { return 330.0 + 0.5 * t; });
  trend.begin(kPlace);
  EXPECT_FALSE(trend.rise().has_value());
}

}  // namespace
}  // namespace kiln
