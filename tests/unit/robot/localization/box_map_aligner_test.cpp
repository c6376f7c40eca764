#include "robot/localization/box_map_aligner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "robot/scene/fire_site_map.h"
#include "tests/unit/robot/localization/synthetic_scan.h"

namespace kiln {
namespace {

using testing::castScan;
using testing::makeBox;
using testing::ScanSettings;

double distance(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }
double turn(const Pose2& a, const Pose2& b) { return std::abs(wrapAngle(a.yaw_rad - b.yaw_rad)); }

class BoxMapAlignerTest : public ::testing::Test {
 protected:
  /// The real kitchen: walls as drawn, everything else up to 15 cm off, some rays lost to things
  /// nobody drew.
  ScanSettings settingsFor(std::uint32_t seed) const {
    ScanSettings settings;
    settings.boxes = arena_.walls;
    for (const auto& box : testing::moved(arena_.furniture, 0.15, seed))
      settings.boxes.push_back(box);
    for (const auto& box : testing::moved(arena_.fixtures.at(kFireSite).boxes, 0.10, seed + 100))
      settings.boxes.push_back(box);
    settings.random_return_fraction = 0.05;
    settings.seed = seed;
    return settings;
  }

  const ArenaMap arena_ = testing::kitchen();
  const BoxMapAligner aligner_{{}, arena_};
};

TEST_F(BoxMapAlignerTest, FindsTheStartPoseFromTwentyCentimetresAndFiveDegrees) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-0.20, 0.20), yaw(-5.0 * kDeg, 5.0 * kDeg);
    const Pose2 truth{shift(random), shift(random), yaw(random)};
    const ScanSettings settings = settingsFor(seed);
    const auto found =
        aligner_.search(castScan(settings, truth), settings.p_base_sensor, arena_.start.pose());
    ASSERT_TRUE(found.has_value()) << "seed " << seed << ": " << found.error();
    EXPECT_LT(distance(found->X_map_base, truth), 0.05) << "seed " << seed;
    EXPECT_LT(turn(found->X_map_base, truth), 0.5 * kDeg) << "seed " << seed;
    EXPECT_EQ(found->observable_directions, 3) << "seed " << seed;
  }
}

TEST_F(BoxMapAlignerTest, TracksWithinTwoCentimetresInsideTheKitchen) {
  std::vector<double> offsets, turns;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(6.6, 11.0), y(-3.0, 3.5), yaw(-M_PI, M_PI),
        shift(-0.10, 0.10), twist(-2.0 * kDeg, 2.0 * kDeg);
    const Pose2 truth{x(random), y(random), yaw(random)};
    const Pose2 prior{truth.x_m + shift(random), truth.y_m + shift(random),
                      truth.yaw_rad + twist(random)};
    const ScanSettings settings = settingsFor(seed);
    const auto found = aligner_.align(castScan(settings, truth), settings.p_base_sensor, prior);
    ASSERT_TRUE(found.has_value()) << "seed " << seed << ": " << found.error();
    offsets.push_back(distance(found->X_map_base, truth));
    turns.push_back(turn(found->X_map_base, truth));
  }
  std::sort(offsets.begin(), offsets.end());
  std::sort(turns.begin(), turns.end());
  EXPECT_LT(offsets[20], 0.02) << "median";
  EXPECT_LT(offsets[38], 0.05) << "p95";
  EXPECT_LT(turns[20], 0.3 * kDeg) << "median";
  EXPECT_LT(turns[38], 0.4 * kDeg) << "p95";
  RecordProperty("position_median_mm", static_cast<int>(1000 * offsets[20]));
}

TEST_F(BoxMapAlignerTest, HoldsWhilePeopleCoverHalfOfTheView) {
  const Pose2 truth{9.0, 0.5, 0.3};
  ScanSettings settings = settingsFor(3);
  // A crowd 1.5 m to the left, 5 m long and as high as the LiDAR sees.
  settings.boxes.push_back(makeBox(9.0, 2.5, 1.2, 5.0, 0.4, 2.4));
  const auto found =
      aligner_.align(castScan(settings, truth), settings.p_base_sensor, {9.08, 0.42, 0.33});
  ASSERT_TRUE(found.has_value()) << found.error();
  EXPECT_LT(distance(found->X_map_base, truth), 0.03);
  EXPECT_LT(turn(found->X_map_base, truth), 0.4 * kDeg);
}

TEST_F(BoxMapAlignerTest, KeepsThePriorAlongACorridor) {
  // Two endless parallel walls: x along them cannot be seen, y and yaw can.
  ArenaMap corridor;
  corridor.walls = {makeBox(0, 2.1, 1.5, 200, 0.2, 3), makeBox(0, -2.1, 1.5, 200, 0.2, 3)};
  ScanSettings settings;
  settings.boxes = corridor.walls;
  const Pose2 truth{0.0, 0.0, 0.0};
  const Pose2 prior{0.15, 0.10, 2.0 * kDeg};
  const BoxMapAligner aligner({}, corridor);
  const auto found = aligner.align(castScan(settings, truth), settings.p_base_sensor, prior);
  ASSERT_TRUE(found.has_value()) << found.error();
  EXPECT_EQ(found->observable_directions, 2);
  EXPECT_NEAR(found->X_map_base.x_m, prior.x_m, 0.02);  // not corrected ...
  EXPECT_GT(found->covariance(0, 0), 1.0);              // ... and said so
  EXPECT_NEAR(found->X_map_base.y_m, 0.0, 0.02);
  EXPECT_LT(found->covariance(1, 1), 0.01);
  EXPECT_NEAR(found->X_map_base.yaw_rad, 0.0, 0.3 * kDeg);
}

TEST_F(BoxMapAlignerTest, RefusesAScanThatShowsOtherWalls) {
  ScanSettings settings;
  settings.boxes = {makeBox(3.0, 1.0, 1.5, 0.3, 3.0, 3), makeBox(-2.0, -2.6, 1.5, 4.0, 0.3, 3)};
  const auto found =
      aligner_.align(castScan(settings, Pose2{}), settings.p_base_sensor, {9.0, 0.0, 0.0});
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, ErrorCode::Degenerate);
}

TEST_F(BoxMapAlignerTest, RefusesEmptyAndNanScansAndPriors) {
  PointCloud cloud;
  EXPECT_EQ(aligner_.align(cloud, {0, 0, 1}, {}).error().code, ErrorCode::Degenerate);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 5000; ++i) cloud.push(nan, nan, nan, 0, 0, 0.0F);
  EXPECT_EQ(aligner_.align(cloud, {0, 0, 1}, {}).error().code, ErrorCode::Degenerate);
  EXPECT_EQ(aligner_.search(cloud, {0, 0, 1}, {std::nan(""), 0, 0}).error().code,
            ErrorCode::InvalidInput);
}

TEST_F(BoxMapAlignerTest, MatchesAThinWallFromTheSideThatIsSeen) {
  const auto segments = wallSegments({makeBox(5.0, 0.0, 1.5, 0.2, 10.0, 3.0)});
  ASSERT_EQ(segments.size(), 4U);
  const auto west = facing(segments, {0.0, 0.0});
  ASSERT_EQ(west.size(), 1U);
  WallMatch match;
  // 15 cm behind the seen face: nearer to the far one, but the far one cannot have returned the
  // ray.
  ASSERT_TRUE(nearestWall(west, {5.05, 1.0, 1.0}, 0.5, match));
  EXPECT_NEAR(match.distance_m, -0.15, 1e-9);
  EXPECT_NEAR(match.direction.x(), -1.0, 1e-9);
  EXPECT_FALSE(match.on_edge);
  ASSERT_TRUE(nearestWall(west, {4.9, 5.2, 1.0}, 0.5, match));  // past the end of the face
  EXPECT_TRUE(match.on_edge);
  EXPECT_NEAR(match.distance_m, 0.2, 1e-9);
  EXPECT_NEAR(match.direction.y(), 1.0, 1e-9);
  EXPECT_FALSE(nearestWall(west, {4.9, 1.0, 3.5}, 0.5, match)) << "above the wall";
}

}  // namespace
}  // namespace kiln
