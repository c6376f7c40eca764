#include "robot/localization/scan_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "tests/support/quantile.h"
#include "tests/unit/robot/localization/synthetic_map.h"

namespace kiln {
namespace {

using testing::caseAt;
using testing::CaseSettings;
using testing::castScan;
using testing::makeBox;
using testing::MatchCase;
using testing::ScanSettings;
using testing::somewhereInside;

const Eigen::Vector3d kSensor = ScanSettings{}.p_base_sensor;

double planar(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).head<2>().norm();
}
double yawBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return std::abs(projectToGround(a.inverse() * b).yaw_rad);
}
using test::quantile;

class ScanMatcherTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    indoor_ = testing::mapOf(testing::mapScans(testing::roundTrip()), {10.0, 0.0, 0.8});
    outdoor_ = testing::mapOf(testing::mapScans(testing::approach()), {3.0, 0.0, 0.8});
  }
  static void TearDownTestSuite() { indoor_ = outdoor_ = nullptr; }
  static std::shared_ptr<const SurfelMap> indoor_, outdoor_;
  const ScanMatcher inside_{{}, indoor_}, outside_{{}, outdoor_};
};
std::shared_ptr<const SurfelMap> ScanMatcherTest::indoor_, ScanMatcherTest::outdoor_;

TEST_F(ScanMatcherTest, FindsItsPoseAmongMovedFurnitureAndPeople) {
  CaseSettings settings;
  settings.extrinsic_m = 0.002;  // what a calibration leaves
  settings.extrinsic_deg = 0.08;
  settings.directions = 900;
  std::vector<double> position, yaw, height;
  int within_two_sigma = 0;
  constexpr int kCases = 60;
  for (std::uint32_t seed = 1; seed <= kCases; ++seed) {
    settings.half_blocked = seed % 3 == 0;
    settings.tilt_deg = seed % 2 == 0 ? 4.0 : 0.0;
    const MatchCase c = caseAt(somewhereInside(seed), settings, seed);
    const auto match = inside_.match(c.scan, c.prior, kSensor);
    ASSERT_TRUE(match.has_value()) << "seed " << seed << ": " << match.error();
    // A crowd hides what little floor the LiDAR sees: then the height is kept.
    EXPECT_GE(match->observable_directions, settings.half_blocked ? 5 : 6) << "seed " << seed;
    position.push_back(planar(match->X_map_base, c.X_map_base));
    yaw.push_back(yawBetween(match->X_map_base, c.X_map_base));
    height.push_back(std::abs((match->X_map_base.translation() - c.X_map_base.translation()).z()));
    const Eigen::Vector3d error = match->X_map_base.translation() - c.X_map_base.translation();
    const double mahalanobis2 =
        error.dot(match->covariance.topLeftCorner<3, 3>().inverse() * error);
    within_two_sigma += mahalanobis2 < 8.02 ? 1 : 0;  // 95 % of chi-squared with 3 degrees
  }
  EXPECT_LT(quantile(position, 0.5), 0.02);
  EXPECT_LT(quantile(position, 0.95), 0.05);
  EXPECT_LT(quantile(yaw, 0.95), 0.4 * kDeg);
  EXPECT_LT(quantile(height, 0.95), 0.03);
  EXPECT_GE(within_two_sigma, static_cast<int>(0.9 * kCases)) << "the covariance is honest";
}

TEST_F(ScanMatcherTest, HoldsTheSidewaysDirectionByTheDoorFromOutside) {
  CaseSettings settings;
  settings.extrinsic_m = settings.extrinsic_deg = 0.0;
  std::vector<double> position, yaw;
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const double x = 0.12 * seed;
    const MatchCase c = caseAt({x, 0.1 - 0.01 * seed, 0.01}, settings, seed);
    const auto match = outside_.match(c.scan, c.prior, kSensor);
    ASSERT_TRUE(match.has_value()) << "x = " << x << ": " << match.error();
    position.push_back(planar(match->X_map_base, c.X_map_base));
    yaw.push_back(yawBetween(match->X_map_base, c.X_map_base));
  }
  EXPECT_LT(quantile(position, 0.5), 0.02);
  EXPECT_LT(quantile(position, 0.95), 0.08);
  EXPECT_LT(quantile(yaw, 0.95), 0.4 * kDeg);
}

TEST_F(ScanMatcherTest, FollowsTheRobotUpASlope) {
  // Ground of 4 deg from x = -5 to the sill at x = 4; the base stands on it.
  ScanSettings settings;
  settings.flat_floor = false;
  settings.boxes = testing::kitchen().walls;
  settings.boxes.push_back(makeBox(9.0, 0, -0.1, 10.0, 12, 0.2));
  const Eigen::Isometry3d X_map_slope =
      makePose({4.0, 0, 0}, {0, -4.0 * kDeg, 0});  // X up along the slope
  auto ramp = makeBox(0, 0, 0, 10.0, 12, 0.2);
  const Eigen::Vector3d center = X_map_slope * Eigen::Vector3d(-5.0, 0, -0.1);
  ramp.center.xyz_m = {center.x(), center.y(), center.z()};
  ramp.center.rpy_deg = {0, -4.0, 0};
  settings.boxes.push_back(ramp);
  SurfelMap map({}, {3.0, 0, 0.8});
  const auto onSlope = [&](double x) { return X_map_slope * makePose({x - 4.0, 0, 0}, {0, 0, 0}); };
  for (double x = 0.0; x < 3.5; x += 0.3)
    testing::insertScan(map, castScan(settings, onSlope(x)), onSlope(x), kSensor);
  map.refresh();
  const ScanMatcher matcher({}, std::make_shared<SurfelMap>(map));
  settings.seed = 9;
  Eigen::Isometry3d prior = onSlope(0.05);
  for (double x = 0.15; x < 3.3; x += 0.1) {  // the prior is the last pose, as it is found
    const auto match = matcher.match(castScan(settings, onSlope(x)), prior, kSensor);
    ASSERT_TRUE(match.has_value()) << "x = " << x << ": " << match.error();
    EXPECT_LT((match->X_map_base.translation() - onSlope(x).translation()).norm(), 0.03) << x;
    EXPECT_LT(rotationAngle(match->X_map_base.inverse() * onSlope(x)), 0.4 * kDeg) << x;
    prior = match->X_map_base;
  }
}

TEST_F(ScanMatcherTest, KeepsThePriorAlongACorridor) {
  ScanSettings settings;
  settings.boxes = {makeBox(0, 2.1, 1.5, 200, 0.2, 3), makeBox(0, -2.1, 1.5, 200, 0.2, 3)};
  SurfelMap map({}, {0, 0, 0.8});
  for (double x = -3; x < 3; x += 0.4)
    testing::insertScan(map, castScan(settings, Pose2{x, 0, 0}), toIsometry({x, 0, 0}), kSensor);
  map.refresh();
  const ScanMatcher matcher({}, std::make_shared<SurfelMap>(map));
  settings.seed = 2;
  const auto match =
      matcher.match(castScan(settings, Pose2{}), toIsometry({0.15, 0.10, 2.0 * kDeg}), kSensor);
  ASSERT_TRUE(match.has_value()) << match.error();
  EXPECT_EQ(match->observable_directions, 5);
  EXPECT_NEAR(match->X_map_base.translation().x(), 0.15, 0.02);  // not corrected ...
  EXPECT_GT(match->covariance(0, 0), 1.0);                       // ... and said so
  EXPECT_NEAR(match->X_map_base.translation().y(), 0.0, 0.02);
  EXPECT_LT(match->covariance(1, 1), 0.01);
  EXPECT_LT(yawBetween(match->X_map_base, Eigen::Isometry3d::Identity()), 0.3 * kDeg);
}

TEST_F(ScanMatcherTest, RecoversFromAWrongStartPoseOrSaysThatItCannot) {
  CaseSettings settings;
  settings.directions = 600;
  settings.prior_m = 0.7;  // up to 1 m along the diagonal
  settings.prior_deg = 20.0;
  int recovered = 0, wrong = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const MatchCase c = caseAt(somewhereInside(seed), settings, seed);
    const auto match = inside_.search(c.scan, c.prior, kSensor);
    if (!match) continue;
    const bool right = planar(match->X_map_base, c.X_map_base) < 0.10 &&
                       yawBetween(match->X_map_base, c.X_map_base) < 2.0 * kDeg;
    ++(right ? recovered : wrong);
  }
  EXPECT_GE(recovered, 39);
  EXPECT_EQ(wrong, 0);
}

TEST_F(ScanMatcherTest, NoticesThatItIsElsewhere) {
  // Carried off by metres: the search must not find a pose that is not there.
  int refused = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const MatchCase c = caseAt(somewhereInside(seed), {.directions = 600}, seed);
    const Eigen::Isometry3d far = toIsometry({0.0, 0.0, 0.5}) * Eigen::Translation3d(1, 0, 0);
    const auto match = outside_.search(c.scan, far, kSensor);
    refused += match ? 0 : 1;
  }
  EXPECT_GE(refused, 19);
}

TEST_F(ScanMatcherTest, RefusesEmptyAndNanScansAndPriors) {
  PointCloud cloud;
  EXPECT_EQ(inside_.match(cloud, Eigen::Isometry3d::Identity()).error().code,
            ErrorCode::Degenerate);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 5000; ++i) cloud.push(nan, nan, nan, 0, 0, 0.0F);
  EXPECT_EQ(inside_.match(cloud, Eigen::Isometry3d::Identity()).error().code,
            ErrorCode::Degenerate);
  Eigen::Isometry3d prior = Eigen::Isometry3d::Identity();
  prior.translation().x() = std::nan("");
  EXPECT_EQ(inside_.search(cloud, prior).error().code, ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace kiln
