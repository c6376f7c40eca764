#include "robot/localization/localizer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "tests/unit/robot/localization/synthetic_scan.h"

namespace kiln {
namespace {

Stamp at(double seconds) { return Stamp{fromSeconds(seconds)}; }

ScanMatch matchAt(const Pose2& X_map_base, double inlier_fraction = 0.9) {
  ScanMatch match;
  match.X_map_base = toIsometry(X_map_base);
  match.covariance.diagonal() << 1e-4, 1e-4, 1e-4, 1e-5, 1e-5, 1e-5;
  match.observable_directions = 6;
  match.inlier_fraction = inlier_fraction;
  return match;
}

/// A robot that stands still; each scan is answered by `see`.
class LocalizerTest : public ::testing::Test {
 protected:
  LocalizerTest() : arena_(testing::kitchen()), localizer_({}, arena_, RobotGeometry{}) {
    localizer_.reset(arena_.start.pose(), at(0));
  }
  AlignmentPrior nextScan() {
    now_s_ += 0.1;
    localizer_.addOdometry(at(now_s_), odometry_);
    const auto prior = localizer_.priorAt(at(now_s_));
    EXPECT_TRUE(prior.has_value());
    return prior.value_or(AlignmentPrior{});
  }
  Result<ScanMatch> fitsAt(const AlignmentPrior& prior, const Pose2& truth) const {
    const Eigen::Vector2d away(prior.X_map_base.x_m - truth.x_m, prior.X_map_base.y_m - truth.y_m);
    const double turn = std::abs(wrapAngle(prior.X_map_base.yaw_rad - truth.yaw_rad));
    if (away.norm() > 1.0 || turn > 20 * kDeg)
      return makeError(ErrorCode::Degenerate, "the map explains 20 % of the scan");
    return matchAt(truth);
  }
  PoseHealth health() const { return localizer_.pose(at(now_s_)).health; }

  ArenaMap arena_;
  Localizer localizer_;
  Pose2 odometry_;
  double now_s_ = 0.0;
};

TEST_F(LocalizerTest, SwitchesMapsBeforeTheDoorAndNotBackAndForth) {
  EXPECT_EQ(localizer_.submap(), Submap::Outdoor);
  const double door_m = arena_.doorway.pose().x_m;
  int switches = 0;
  Submap last = localizer_.submap();
  const auto driveTo = [&](double x_m) {
    odometry_.x_m = x_m;
    (void)nextScan();
    switches += localizer_.submap() != last ? 1 : 0;
    last = localizer_.submap();
  };
  for (double x = 0.0; x < door_m - 1.3; x += 0.1) driveTo(x);
  EXPECT_EQ(switches, 0);
  driveTo(door_m - 1.1);
  EXPECT_EQ(localizer_.submap(), Submap::Indoor) << "before the doorway";
  for (int i = 0; i < 10; ++i) driveTo(door_m - 1.2 + (i % 2 == 0 ? -0.2 : 0.2));
  EXPECT_EQ(switches, 1) << "hysteresis";
  driveTo(door_m - 2.3);
  EXPECT_EQ(localizer_.submap(), Submap::Outdoor);
}

TEST_F(LocalizerTest, FindsAKidnappedRobotAgainAndBelievesTheSecondScanOnly) {
  ASSERT_TRUE(localizer_.addResult(nextScan(), matchAt({})));
  EXPECT_EQ(health(), PoseHealth::Good);
  const Pose2 truth{10.3, -2.9, 100 * kDeg};
  int fixes = 0, scans = 0;
  bool lost = false;
  while (fixes == 0 && scans < 3000) {
    const AlignmentPrior prior = nextScan();
    fixes += localizer_.addResult(prior, fitsAt(prior, truth)) ? 1 : 0;
    lost = lost || health() == PoseHealth::Lost;
    ++scans;
  }
  EXPECT_TRUE(lost) << "nothing may drive while the robot is searched for";
  ASSERT_EQ(fixes, 1);
  EXPECT_EQ(health(), PoseHealth::Good);
  const Pose2 found = localizer_.pose(at(now_s_)).X_map_base;
  EXPECT_NEAR(found.x_m, truth.x_m, 0.02);
  EXPECT_NEAR(found.y_m, truth.y_m, 0.02);
  EXPECT_EQ(localizer_.submap(), Submap::Indoor);
  const AlignmentPrior next = nextScan();
  EXPECT_FALSE(next.search);
  EXPECT_FALSE(next.elsewhere);
}

TEST_F(LocalizerTest, DoesNotBelieveAPlaceThatOnlyOneScanFits) {
  ASSERT_TRUE(localizer_.addResult(nextScan(), matchAt({})));
  bool fits = false;
  for (int i = 0; i < 400; ++i) {
    const AlignmentPrior prior = nextScan();
    // Every scan "fits" wherever it is looked for, but never twice at one place.
    const double shift = fits ? 0.5 : -0.5;
    const bool guess = prior.elsewhere;
    Pose2 seen = prior.X_map_base;
    seen.x_m += shift;
    fits = guess ? !fits : fits;
    const auto answer = guess ? Result<ScanMatch>(matchAt(seen))
                              : makeError(ErrorCode::Degenerate, "explains 5 % of the scan");
    EXPECT_FALSE(localizer_.addResult(prior, answer));
  }
  EXPECT_EQ(health(), PoseHealth::Lost);
}

}  // namespace
}  // namespace kiln
