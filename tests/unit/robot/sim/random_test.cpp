#include "robot/sim/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace kiln::sim {
namespace {

TEST(Random, NormalHasZeroMeanUnitVarianceAndNormalTails) {
  Random random(1, "test");
  constexpr int kCount = 400000;
  double sum = 0, squares = 0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    beyond_two += std::fabs(x) > 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 5.0 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 0.01);
  EXPECT_NEAR(static_cast<double>(beyond_two) / kCount, 0.0455, 0.002);
}

TEST(Random, SameSeedAndPurposeRepeatOthersDiffer) {
  Random a(5, "lidar"), b(5, "lidar"), c(5, "thermal"), d(6, "lidar");
  const auto first = a.bits();
  EXPECT_EQ(first, b.bits());
  EXPECT_NE(first, c.bits());
  EXPECT_NE(first, d.bits());
}

}  // namespace
}  // namespace kiln::sim
