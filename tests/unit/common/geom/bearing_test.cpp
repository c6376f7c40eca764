#include "common/geom/bearing.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(Bearing, IsAtan2WithinTwoHundredthsOfAMilliradian) {
  for (int i = -36000; i <= 36000; ++i) {
    const double angle = i * M_PI / 36000.0;
    for (const double radius : {1e-3, 1.0, 100.0}) {
      const auto x = static_cast<float>(radius * std::cos(angle));
      const auto y = static_cast<float>(radius * std::sin(angle));
      ASSERT_NEAR(bearing(y, x), std::atan2(y, x), 2e-5) << angle << " at " << radius;
    }
  }
}

TEST(Bearing, HasAnAnswerWhereThereIsNoDirection) {
  EXPECT_EQ(bearing(0.0F, 0.0F), 0.0F);
  EXPECT_NEAR(bearing(0.0F, -1.0F), M_PI, 2e-5);
  EXPECT_TRUE(std::isnan(bearing(NAN, 1.0F)));
  EXPECT_TRUE(std::isnan(bearing(1.0F, NAN)));
}

}  // namespace
}  // namespace kiln
