#include "robot/perception/calibration/wet_spot.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

/// A board of 45 degC with a camera's fixed pattern and noise, cooled around a place.
ThermalImage board(std::uint32_t frame, double u, double v, double depth_k, double sigma_px = 4.0) {
  std::mt19937 pattern(1), random(frame);
  std::normal_distribution<double> fixed(0.0, 0.3), noise(0.0, 0.05);
  ThermalImage out;
  out.frame_counter = frame;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double r2 = (x - u) * (x - u) + (y - v) * (y - v);
      const double kelvin = 318.15 + fixed(pattern) + noise(random) -
                            depth_k * std::exp(-0.5 * r2 / (sigma_px * sigma_px));
      out.counts.push_back(static_cast<std::uint16_t>(100.0 * kelvin));
    }
  }
  return out;
}

TEST(WetSpot, IsWhereTheBoardBecameCooler) {
  const auto spot = findWetSpot(board(1, 80, 60, 0.0), board(2, 71.3, 48.8, 6.0), {});
  ASSERT_TRUE(spot.has_value()) << spot.error();
  EXPECT_NEAR(spot->centre_px.x(), 71.3, 0.1);
  EXPECT_NEAR(spot->centre_px.y(), 48.8, 0.1);
  EXPECT_NEAR(spot->coolest_k, 6.0, 0.5);
}

// What was wet before does not pull the centre: the older spot, 10 px aside, is in both pictures.
TEST(WetSpot, IgnoresWhatWasWetBefore) {
  const ThermalImage before = board(1, 90, 60, 6.0);
  ThermalImage after = board(2, 80, 60, 6.0);
  const ThermalImage old = board(2, 90, 60, 6.0), dry = board(2, 0, 0, 0.0);
  for (std::size_t i = 0; i < after.counts.size(); ++i)
    after.counts[i] = static_cast<std::uint16_t>(after.counts[i] + old.counts[i] - dry.counts[i]);
  const auto spot = findWetSpot(before, after, {});
  ASSERT_TRUE(spot.has_value()) << spot.error();
  EXPECT_NEAR(spot->centre_px.x(), 80.0, 0.15);
}

TEST(WetSpot, RefusesWhatIsNoSpot) {
  const ThermalImage dry = board(1, 80, 60, 0.0), wet = board(2, 80, 60, 6.0);
  const auto code = [](const Result<WetSpot>& spot) {
    return spot ? ErrorCode::Fault : spot.error().code;
  };
  EXPECT_EQ(code(findWetSpot(dry, board(2, 80, 60, 0.0), {})), ErrorCode::NotFound);
  EXPECT_EQ(code(findWetSpot(wet, board(3, 80, 60, 0.0), {})), ErrorCode::NotFound) << "warmer";
  EXPECT_EQ(code(findWetSpot(dry, board(2, 3, 60, 6.0), {})), ErrorCode::NotFound) << "cut";
  EXPECT_EQ(code(findWetSpot(dry, dry, {})), ErrorCode::InvalidInput) << "frozen";
  ThermalImage bad = wet;
  bad.counts.resize(100);
  EXPECT_EQ(code(findWetSpot(dry, bad, {})), ErrorCode::InvalidInput);
  bad = wet;
  bad.ffc = FfcState::Running;
  EXPECT_EQ(code(findWetSpot(dry, bad, {})), ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace kiln
