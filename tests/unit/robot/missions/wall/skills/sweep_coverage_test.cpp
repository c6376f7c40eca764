#include "robot/missions/wall/skills/sweep_coverage.h"

#include <vector>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/geom/pose.h"

namespace kiln {
namespace {

std::vector<Eigen::Isometry3d> tilting(double from_deg, double step_deg, int scans) {
  std::vector<Eigen::Isometry3d> out;
  for (int k = 0; k < scans; ++k)
    out.push_back(makePose({0, 0, 1.5}, {0, (from_deg + step_deg * k) * kDeg, 0.3}));
  return out;
}

/// 21 scans from 10 deg on, 0.5 deg each: lines of all lasers coincide every fourth scan, so in the
/// middle the distinct ones are 0.5 deg apart.
TEST(SweepCoverage, TellsTiltStepAndGaps) {
  const SweepCoverage c = coverageOf(tilting(10.0, 0.5, 21));
  EXPECT_NEAR(c.tilt_from_deg, 10.0, 1e-9);
  EXPECT_NEAR(c.tilt_to_deg, 20.0, 1e-9);
  EXPECT_NEAR(c.step_deg, 0.5, 1e-9);
  EXPECT_NEAR(c.widest_gap_deg, 0.5, 1e-6);
  EXPECT_GT(c.line_gap_deg, 0.05);
  EXPECT_LT(c.line_gap_deg, 0.2);
}

TEST(SweepCoverage, ALidarThatStandsStillLeavesTheGapsOfItsLasers) {
  const SweepCoverage c = coverageOf(tilting(10.0, 0.0, 40));
  EXPECT_NEAR(c.step_deg, 0.0, 1e-9);
  EXPECT_NEAR(c.widest_gap_deg, 2.0, 1e-6);
}

TEST(SweepCoverage, OneScanIsNoSweep) {
  EXPECT_EQ(coverageOf(tilting(0, 0, 1)).widest_gap_deg, 0.0);
  EXPECT_EQ(coverageOf({}).step_deg, 0.0);
}

}  // namespace
}  // namespace kiln
