#include "robot/localization/pose_tracker.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/localization/scan_locator.h"
#include "tests/unit/robot/localization/synthetic_scan.h"

namespace kiln {
namespace {

using testing::castScan;
using testing::ScanSettings;

Stamp at(double seconds) { return Stamp{fromSeconds(seconds)}; }

double distance(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

ScanMatch fixAt(const AlignmentPrior& prior, const Pose2& X_map_base) {
  ScanMatch fix;
  fix.stamp = prior.stamp;
  fix.X_map_base = toIsometry(X_map_base);
  fix.covariance.diagonal() << 1e-4, 1e-4, 1e-4, 1e-5, 1e-5, 1e-5;
  fix.observable_directions = 6;
  fix.inlier_fraction = 0.9;
  return fix;
}

TEST(PoseTracker, IsLostUntilTheFirstFixThenTakesItAtOnce) {
  PoseTracker tracker({});
  tracker.reset(Eigen::Isometry3d::Identity(), at(0));
  EXPECT_FALSE(tracker.priorAt(at(0)).has_value()) << "no odometry yet";
  tracker.addOdometry(at(0.02), {1.0, 2.0, 0.5});  // odometry need not start at zero
  EXPECT_EQ(tracker.pose(at(0.02)).health, PoseHealth::Lost);
  EXPECT_NEAR(tracker.pose(at(0.02)).X_map_base.x_m, 0.0, 1e-9) << "the reset pose holds";
  const auto prior = tracker.priorAt(at(0.02));
  ASSERT_TRUE(prior.has_value());
  EXPECT_TRUE(prior->search);
  EXPECT_TRUE(tracker.addFix(*prior, fixAt(*prior, {0.2, -0.1, 3 * kDeg})));
  const TrackedPose pose = tracker.pose(at(0.03));
  EXPECT_EQ(pose.health, PoseHealth::Good);
  EXPECT_NEAR(pose.age_s, 0.01, 1e-9);
  EXPECT_NEAR(pose.X_map_base.x_m, 0.2,
              0.002);  // prior sigma 20 cm against 1 cm: within 1 % of the fix
  EXPECT_NEAR(pose.X_map_base.yaw_rad, 3 * kDeg, 0.1 * kDeg);
  EXPECT_FALSE(tracker.priorAt(at(0.02))->search);
}

TEST(PoseTracker, LimitsHowFastACorrectionReachesControl) {
  PoseTracker tracker({});
  tracker.reset(Eigen::Isometry3d::Identity(), at(0));
  tracker.addOdometry(at(0), {});
  const auto first = tracker.priorAt(at(0));
  ASSERT_TRUE(tracker.addFix(*first, fixAt(*first, {})));
  // 5 m straight on with odometry that says so; the truth went 12 cm to the left.
  for (int i = 1; i <= 500; ++i) tracker.addOdometry(at(0.01 * i), {0.01 * i, 0.0, 0.0});
  const auto prior = tracker.priorAt(at(5.0));
  const Pose2 before = tracker.pose(at(5.0)).X_map_base;
  ASSERT_TRUE(tracker.addFix(*prior, fixAt(*prior, {5.0, 0.12, 1 * kDeg})));
  EXPECT_NEAR(tracker.pose(at(5.0)).X_map_base.y_m, before.y_m, 1e-9) << "no jump";
  Pose2 last = before;
  for (int i = 1; i <= 200; ++i) {
    tracker.addOdometry(at(5.0 + 0.01 * i), {5.0, 0.0, 0.0});
    const Pose2 now = tracker.pose(at(5.0 + 0.01 * i)).X_map_base;
    EXPECT_LE(distance(now, last), 0.25 * 0.01 + 1e-9);
    EXPECT_LE(std::abs(now.yaw_rad - last.yaw_rad), 8 * kDeg * 0.01 + 1e-9);
    last = now;
  }
  EXPECT_NEAR(last.y_m, 0.12, 0.02);
}

TEST(PoseTracker, RefusesAWildFixAndSearchesAfterFive) {
  PoseTracker tracker({});
  tracker.reset(Eigen::Isometry3d::Identity(), at(0));
  tracker.addOdometry(at(0), {});
  const auto first = tracker.priorAt(at(0));
  ASSERT_TRUE(tracker.addFix(*first, fixAt(*first, {})));
  for (int i = 1; i <= 5; ++i) {
    tracker.addOdometry(at(0.1 * i), {});
    const auto prior = tracker.priorAt(at(0.1 * i));
    EXPECT_FALSE(prior->search);
    EXPECT_FALSE(tracker.addFix(*prior, fixAt(*prior, {1.0, 0.0, 0.0})));
    EXPECT_NEAR(tracker.pose(at(0.1 * i)).X_map_base.x_m, 0.0, 1e-6);
  }
  EXPECT_EQ(tracker.pose(at(0.5)).rejected, 5U);
  // Five in a row say the belief is wrong, not the scans: the next one searches. What it finds a
  // metre away stops the robot first and is believed when it is found again.
  const auto prior = tracker.priorAt(at(0.5));
  ASSERT_TRUE(prior->search);
  EXPECT_FALSE(tracker.addFix(*prior, fixAt(*prior, {1.0, 0.0, 0.0})));
  EXPECT_EQ(tracker.pose(at(0.5)).health, PoseHealth::Lost);
  EXPECT_NE(tracker.pose(at(0.5)).reason.find("carried"), std::string::npos);
  EXPECT_NEAR(tracker.pose(at(0.5)).X_map_base.x_m, 0.0, 1e-6);
  const auto again = tracker.priorAt(at(0.5));
  ASSERT_TRUE(again->search);
  EXPECT_TRUE(tracker.addFix(*again, fixAt(*again, {1.0, 0.0, 0.0})));
  EXPECT_EQ(tracker.pose(at(0.5)).health, PoseHealth::Good);
  EXPECT_NEAR(tracker.pose(at(0.5)).X_map_base.x_m, 1.0, 1e-6) << "at once: it stands";
  EXPECT_FALSE(tracker.priorAt(at(0.5))->search);
}

TEST(PoseTracker, AFewCentimetresThatASearchFindsStopNobody) {
  PoseTracker tracker({});
  tracker.reset(Eigen::Isometry3d::Identity(), at(0));
  tracker.addOdometry(at(0), {});
  const auto first = tracker.priorAt(at(0));
  ASSERT_TRUE(tracker.addFix(*first, fixAt(*first, {})));
  for (int i = 1; i <= 6; ++i) {
    tracker.addOdometry(at(0.1 * i), {});
    const auto prior = tracker.priorAt(at(0.1 * i));
    EXPECT_EQ(tracker.addFix(*prior, fixAt(*prior, {0.2, 0.0, 0.0})), i == 6);
    EXPECT_EQ(tracker.pose(at(0.1 * i)).health, PoseHealth::Good);
  }
  EXPECT_LT(tracker.pose(at(0.6)).X_map_base.x_m, 0.03) << "not at once: it may be driving";
}

TEST(PoseTracker, IgnoresAFixFromBeforeAReset) {
  PoseTracker tracker({});
  tracker.reset(Eigen::Isometry3d::Identity(), at(0));
  tracker.addOdometry(at(0), {});
  const auto stale = tracker.priorAt(at(0));
  tracker.reset(Eigen::Isometry3d::Identity(), at(1));
  tracker.addOdometry(at(1), {});
  EXPECT_FALSE(tracker.addFix(*stale, fixAt(*stale, {0.3, 0.3, 0.0})));
  EXPECT_EQ(tracker.pose(at(1)).health, PoseHealth::Lost);
}

TEST(PoseTracker, GoesFromGoodToDegradedToLostWithoutFixes) {
  PoseTracker tracker({});
  tracker.reset(Eigen::Isometry3d::Identity(), at(0));
  tracker.addOdometry(at(0), {});
  const auto prior = tracker.priorAt(at(0));
  ASSERT_TRUE(tracker.addFix(*prior, fixAt(*prior, {})));
  EXPECT_EQ(tracker.pose(at(1.0)).health, PoseHealth::Good);
  EXPECT_EQ(tracker.pose(at(2.0)).health, PoseHealth::Degraded);
  EXPECT_EQ(tracker.pose(at(21.0)).health, PoseHealth::Lost);
}

TEST(PoseTracker, FollowsTheSlopeItStandsOnBetweenFixes) {
  PoseTracker tracker({});
  tracker.reset(Eigen::Isometry3d::Identity(), at(0));
  tracker.addOdometry(at(0), {});
  const auto prior = tracker.priorAt(at(0));
  ScanMatch fix = fixAt(*prior, {});
  fix.X_map_base = makePose({0, 0, -0.2}, {0, -4 * kDeg, 0});  // nose up
  ASSERT_TRUE(tracker.addFix(*prior, fix));
  tracker.addOdometry(at(0.1), {0.1, 0.0, 0.0});
  const Eigen::Isometry3d uphill = tracker.pose(at(0.1)).X_map_base_3d;
  EXPECT_NEAR(uphill.translation().z(), -0.2 + 0.1 * std::tan(4 * kDeg), 2e-4);
  EXPECT_NEAR(rotationAngle(uphill.inverse() * fix.X_map_base), 0.0, 1e-3);
  // Turned across the slope the robot leans sideways by as much.
  tracker.addOdometry(at(0.2), {0.1, 0.0, 90 * kDeg});
  const Eigen::Isometry3d across = tracker.pose(at(0.2)).X_map_base_3d;
  EXPECT_NEAR(across.linear()(2, 0), 0.0, 2e-3);
  EXPECT_NEAR(across.linear()(2, 1), -std::sin(4 * kDeg), 2e-3);
}

TEST(PoseTracker, IsLostAfterScansThatDoNotFitAndSaysWhy) {
  PoseTracker tracker({});
  tracker.reset(Eigen::Isometry3d::Identity(), at(0));
  tracker.addOdometry(at(0), {});
  const auto first = tracker.priorAt(at(0));
  ASSERT_TRUE(tracker.addFix(*first, fixAt(*first, {})));
  for (int i = 1; i <= 20; ++i) {
    tracker.addOdometry(at(0.05 * i), {});
    tracker.addFailure(*tracker.priorAt(at(0.05 * i)), "the map explains 12 % of the scan");
  }
  const TrackedPose pose = tracker.pose(at(1.0));
  EXPECT_EQ(pose.health, PoseHealth::Lost);
  EXPECT_NE(pose.reason.find("explains 12 %"), std::string::npos) << pose.reason;
}

TEST(PoseTracker, IgnoresBadOdometryAndInterpolatesTheRest) {
  PoseTracker tracker({});
  tracker.reset(Eigen::Isometry3d::Identity(), at(0));
  tracker.addOdometry(at(1.0), {1.0, 0.0, 179 * kDeg});
  tracker.addOdometry(at(1.1), {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  tracker.addOdometry(at(0.5), {9.0, 9.0, 0.0});
  tracker.addOdometry(at(1.2), {1.2, 0.0, -179 * kDeg});
  ASSERT_TRUE(tracker.odometryAt(at(1.1)).has_value());
  EXPECT_NEAR(tracker.odometryAt(at(1.1))->x_m, 1.1, 1e-9);
  EXPECT_NEAR(std::abs(tracker.odometryAt(at(1.1))->yaw_rad), M_PI, 1e-9) << "across the wrap";
  EXPECT_FALSE(tracker.odometryAt(at(0.9)).has_value());
  EXPECT_NEAR(tracker.odometryAt(at(9.0))->x_m, 1.2, 1e-9);
}

/// The way of the mission: from a wrong start through the door to the first work pose, with
/// odometry that errs as scenario.md section 2 says (wheel radius 0.5 %, steering 0.3 deg -> 0.5 %
/// along, 0.3 deg aside, and a turn).
TEST(PoseTracker, KeepsThePoseFromTheStartThroughTheDoor) {
  const ArenaMap arena = testing::kitchen();
  const WallLocator locator({}, arena);
  ScanSettings settings;
  settings.boxes = arena.walls;
  for (const auto& box : testing::moved(arena.furniture, 0.15, 5)) settings.boxes.push_back(box);
  settings.random_return_fraction = 0.05;

  PoseTracker tracker({});
  tracker.reset(toIsometry(arena.start.pose()), at(0));
  Pose2 truth{0.15, -0.18, 4 * kDeg};
  Pose2 X_odom_base;
  double worst_inside = 0.0;
  const double speed_mps = 0.8, dt_s = 0.1;
  for (int i = 0; i <= 120; ++i) {
    if (i > 0) {
      const Pose2 step{speed_mps * dt_s, -0.4 * truth.y_m * dt_s, -0.5 * truth.yaw_rad * dt_s};
      truth = truth * step;
      X_odom_base = X_odom_base * Pose2{1.005 * step.x_m, step.y_m + 0.005 * step.x_m,
                                        step.yaw_rad + 0.3 * kDeg * step.x_m};
    }
    const Stamp stamp = at(dt_s * (i + 1));
    tracker.addOdometry(stamp, X_odom_base);
    settings.seed = static_cast<std::uint32_t>(i + 1);
    const auto scan = castScan(settings, truth);
    const auto prior = tracker.priorAt(stamp);
    const auto found = locator.locate(scan, settings.p_base_sensor, *prior);
    if (found) {
      tracker.addFix(*prior, *found);
    } else {
      tracker.addFailure(*prior, found.error().message);
    }
    const TrackedPose pose = tracker.pose(stamp);
    EXPECT_NE(pose.health, PoseHealth::Lost) << "at x " << truth.x_m;
    if (truth.x_m > 5.5) worst_inside = std::max(worst_inside, distance(pose.X_map_base, truth));
  }
  EXPECT_GT(truth.x_m, 9.0);
  EXPECT_LT(worst_inside, 0.05);
}

}  // namespace
}  // namespace kiln
