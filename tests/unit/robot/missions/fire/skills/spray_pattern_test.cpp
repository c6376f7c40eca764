#include "robot/missions/fire/skills/spray_pattern.h"

#include <cmath>

#include <gtest/gtest.h>

#include "robot/missions/fire/skills/aim_solver.h"
#include "robot/missions/fire/skills/jet.h"

namespace kiln {
namespace {

const AimTarget kTarget{{12.1, 2.8, 1.0}, {-1.0, 0.0, 0.0}, 0.10};

Eigen::Isometry3d steadyAim() { return aimNozzle(kTarget, {}, {}, 1.0); }

TEST(SprayPattern, IsAClosedHourglassAroundTheSteadyAim) {
  const auto path = hourglass(steadyAim(), {});
  ASSERT_EQ(path.size(), 17u) << "four edges of four points and the start";
  EXPECT_TRUE(path.front().isApprox(path.back()));
  std::vector<JetMiss> hits;
  for (const Eigen::Isometry3d& X : path)
    hits.push_back(jetMiss({}, X, kTarget.p_opening_map(), kTarget.normal_map, 1.0));
  // Corners in order: top left, top right, bottom left, bottom right.
  const int sides[] = {1, -1, 1, -1};
  const int heights[] = {1, 1, -1, -1};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    EXPECT_GT(sides[corner] * hits[4 * corner].lateral_m, 0.015) << corner;
    EXPECT_GT(heights[corner] * hits[4 * corner].vertical_m, 0.012) << corner;
  }
  // Both diagonals cross in the middle.
  EXPECT_LT(hits[6].distance_m, 0.004);
  EXPECT_LT(hits[14].distance_m, 0.004);
}

TEST(SprayPattern, KeepsTheNozzleInPlaceAndTheJetInTheOpening) {
  for (const Eigen::Isometry3d& X : hourglass(steadyAim(), {})) {
    EXPECT_LT((X.translation() - steadyAim().translation()).norm(), 1e-12);
    const JetMiss hit = jetMiss({}, X, kTarget.p_opening_map(), kTarget.normal_map, 1.0);
    // Opening of 15 cm; the cone of 2 deg rms is 2.4 cm wide at 0.7 m.
    EXPECT_LT(std::abs(hit.lateral_m), 0.075 - 0.024);
    EXPECT_LT(std::abs(hit.vertical_m), 0.075 - 0.024);
  }
}

}  // namespace
}  // namespace kiln
