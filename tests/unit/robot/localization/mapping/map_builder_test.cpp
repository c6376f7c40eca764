#include "robot/localization/mapping/map_builder.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "tests/unit/robot/localization/synthetic_map.h"

namespace kiln {
namespace {

using testing::ScanSettings;

/// Wheels that are 1 % too small and pull to one side by 0.4 deg a metre.
class DriftingOdometry {
 public:
  Pose2 after(const Pose2& X_map_base) {
    const Pose2 step = inverse(last_) * X_map_base;
    const double distance = std::hypot(step.x_m, step.y_m);
    odometry_ =
        odometry_ * Pose2{1.01 * step.x_m, 1.01 * step.y_m, step.yaw_rad + 0.4 * kDeg * distance};
    last_ = X_map_base;
    return odometry_;
  }

 private:
  Pose2 last_, odometry_;
};

/// In through the door, a round, back to the door: what a person drives to make a map.
std::vector<Pose2> mappingDrive() {
  std::vector<Pose2> drive;
  for (const Pose2& X : testing::approach()) drive.push_back(X);
  for (const Pose2& X : testing::roundTrip()) drive.push_back(X);
  return drive;
}

class MapBuilderTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    MapBuilder builder({}, testing::kitchen());
    DriftingOdometry odometry;
    ScanSettings settings;
    settings.boxes = testing::kitchen().walls;
    for (const auto& box : testing::kitchen().furniture) settings.boxes.push_back(box);
    settings.directions = 600;
    // Put down 10 cm and 3 deg off; the map must come out in the arena's frame all the same.
    const Pose2 put_down{0.08, -0.06, 3 * kDeg};
    truth_ = new std::vector<Pose2>;
    for (const Pose2& X : mappingDrive()) {
      const Pose2 at = X.x_m < 0.1 ? put_down : X;
      const auto added =
          builder.addScan(castScan(settings, at), odometry.after(at), settings.p_base_sensor);
      ASSERT_TRUE(added.has_value()) << added.error();
      if (*added) truth_->push_back(at);
    }
    auto built = builder.build();
    ASSERT_TRUE(built.has_value()) << built.error();
    built_ = new BuiltMap(std::move(*built));
  }
  static void TearDownTestSuite() {
    delete built_;
    delete truth_;
  }
  static BuiltMap* built_;
  static std::vector<Pose2>* truth_;
};
BuiltMap* MapBuilderTest::built_ = nullptr;
std::vector<Pose2>* MapBuilderTest::truth_ = nullptr;

TEST_F(MapBuilderTest, PutsEveryKeyframeWithinThreeCentimetresInTheArenaFrame) {
  ASSERT_EQ(built_->poses.size(), truth_->size());
  for (std::size_t i = 0; i < truth_->size(); ++i) {
    const Eigen::Isometry3d error = toIsometry((*truth_)[i]).inverse() * built_->poses[i];
    EXPECT_LT(error.translation().norm(), 0.03) << "keyframe " << i;
    EXPECT_LT(rotationAngle(error), 0.4 * kDeg) << "keyframe " << i;
  }
}

TEST_F(MapBuilderTest, ReportsLoopsOverlapsAndResiduals) {
  const MapReport& report = built_->report;
  EXPECT_GE(report.loops, 2);
  EXPECT_LT(report.loop.rms_m, 0.03);
  EXPECT_GT(report.odometry.rms_m, report.registration.rms_m) << "the wheels drift";
  EXPECT_GT(report.overlap_min, 0.4);
  EXPECT_LT(report.rms_median_m, 0.02);
  EXPECT_LT(report.wall_rms_m, 0.03);
  ASSERT_EQ(report.segments.size(), 2U);
  EXPECT_EQ(report.segments[0].name, "outdoor");
  EXPECT_EQ(report.segments[1].name, "indoor");
  EXPECT_GT(report.segments[1].wall_coverage, 0.6);
  EXPECT_NE(formatReport(report).find("indoor"), std::string::npos);
}

TEST_F(MapBuilderTest, MakesAMapThatLocalises) {
  const auto map = built_->map.find("indoor");
  ASSERT_NE(map, nullptr);
  const ScanMatcher matcher({}, map);
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const auto c = testing::caseAt(testing::somewhereInside(seed),
                                   {.extrinsic_m = 0, .extrinsic_deg = 0, .directions = 900}, seed);
    const auto match = matcher.match(c.scan, c.prior);
    ASSERT_TRUE(match.has_value()) << match.error();
    const Eigen::Isometry3d error = c.X_map_base.inverse() * match->X_map_base;
    EXPECT_LT(error.translation().norm(), 0.05) << "seed " << seed;
  }
}

TEST(MapBuilder, RefusesTooShortADriveAndForeignWalls) {
  ScanSettings settings;
  settings.boxes = testing::kitchen().walls;
  settings.directions = 300;
  MapBuilder builder({}, testing::kitchen());
  ASSERT_TRUE(builder.addScan(castScan(settings, Pose2{}), {}, settings.p_base_sensor).has_value());
  EXPECT_EQ(builder.build().error().code, ErrorCode::Degenerate);
  EXPECT_FALSE(*builder.addScan(castScan(settings, Pose2{}), {}, settings.p_base_sensor))
      << "has not moved";
}

}  // namespace
}  // namespace kiln
