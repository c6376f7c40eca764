// What stands near the robot, in the driver's figures.
#include "gui/views/scene3d/clearance.h"

#include <cmath>

#include "common/core/units.h"
#include "gui/views/scene3d/pose_chip.h"
#include "gui/views/scene3d/scene_tile.h"
#include "tests/gui/views/station_fixture.h"

namespace kiln::gui {
namespace {

/// A wall of points across the way, and what must not count.
SceneSnapshot wallAhead(double x_m) {
  SceneSnapshot snapshot;
  snapshot.robot_known = true;
  snapshot.X_map_base = {2.0, 1.0, M_PI / 2};  // looks along Y of the map
  auto cloud = std::make_shared<PointCloud>();
  cloud->frame = "map";
  for (int i = 0; i < 9; ++i)
    cloud->push(float(2.0 + 0.05 * (i - 4)), float(1.0 + x_m), 0.6F, 0, 0, 0);
  cloud->push(2.0F, 2.0F, 0.05F, 0, 0, 0);  // the ground, 1 m ahead
  cloud->push(2.1F, 1.2F, 1.0F, 0, 0, 0);   // its own arm
  cloud->push(2.0F, -0.2F, 0.5F, 0, 0, 0);  // one stray point behind
  cloud->push(2.0F, 2.2F, 2.4F, 0, 0, 0);   // a lintel
  cloud->push(NAN, NAN, NAN, 0, 0, 0);
  snapshot.cloud = cloud;
  return snapshot;
}

TEST(Clearance, IsFromTheFootprintsEdgeToWhatStandsInTheWay) {
  RobotGeometry geometry;
  geometry.length_m = 1.9;
  geometry.width_m = 1.4;
  const auto found = ClearanceMeter().look(wallAhead(1.75), geometry);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance_m, 0.80, 1e-3);  // 1.75 m less half of 1.9 m
  EXPECT_STREQ(sideWord(found->bearing_rad), "ahead");
  SceneSnapshot nothing = wallAhead(1.75);
  nothing.cloud.reset();
  EXPECT_FALSE(ClearanceMeter().look(nothing, geometry));
}

/// wallAhead() with so much between wall and footprint, at a time; `seen`: the wall is in it.
SceneSnapshot gapAhead(double gap_m, double at_s, bool seen = true) {
  SceneSnapshot snapshot;
  snapshot.robot_known = true;
  snapshot.X_map_base = {10.0 - 0.95 - gap_m, 0.0, 0.0};
  auto cloud = std::make_shared<PointCloud>();
  cloud->stamp = Stamp{fromSeconds(at_s)};
  for (int i = 0; seen && i < 20; ++i) cloud->push(10.0F, 0.01F * float(i), 0.6F, 0, 0, 0);
  for (int i = 0; i < 20; ++i) cloud->push(15.0F, 0.01F * float(i), 0.6F, 0, 0, 0);
  snapshot.cloud = cloud;
  return snapshot;
}

TEST(Clearance, WhatTouchesTheRobotDoesNotVanish) {
  RobotGeometry geometry;
  geometry.length_m = 1.9;
  geometry.width_m = 1.4;
  ClearanceMeter meter;
  const auto gap = [&](double gap_m, double at_s, bool seen) {
    const auto found = meter.look(gapAhead(gap_m, at_s, seen), geometry);
    EXPECT_STREQ(sideWord(found ? found->bearing_rad : 9.0), "ahead");
    return found ? found->distance_m : NAN;
  };
  EXPECT_NEAR(gap(0.30, 0.0, true), 0.30, 1e-3);
  EXPECT_NEAR(gap(0.04, 0.2, true), 0.04, 1e-3);
  EXPECT_NEAR(gap(0.01, 0.4, true), 0.01, 1e-3);
  EXPECT_EQ(gap(-0.06, 0.6, true), 0.0) << "the robot has moved since the scan";
  EXPECT_EQ(gap(-0.02, 0.8, false), 0.0) << "lost by the scan, and yet there";
  EXPECT_NEAR(gap(0.05, 2.0, false), 0.05, 1e-3) << "backing off";
  EXPECT_NEAR(gap(0.12, 3.0, false), 15.0 - 10.0 + 0.12, 1e-3) << "it would be seen now";
  EXPECT_NEAR(gap(0.05, 4.0, false), 15.0 - 10.0 + 0.05, 1e-3) << "and was not";
}

TEST(Clearance, WhatWasNearIsForgottenInTimeAndNoiseAtOnce) {
  RobotGeometry geometry;
  geometry.length_m = 1.9;
  geometry.width_m = 1.4;
  ClearanceMeter meter;
  (void)meter.look(gapAhead(0.05, 100.0), geometry);
  EXPECT_NEAR(meter.look(gapAhead(0.05, 119.0, false), geometry)->distance_m, 0.05, 1e-3);
  EXPECT_GT(meter.look(gapAhead(0.05, 121.0, false), geometry)->distance_m, 1.0);
  (void)meter.look(gapAhead(0.05, 130.0), geometry);
  EXPECT_GT(meter.look(gapAhead(0.05, 60.0, false), geometry)->distance_m, 1.0)
      << "a jump in a recording";
  for (int i = 0; i < 9; ++i) {  // one stray point a scan, each elsewhere
    SceneSnapshot stray = gapAhead(0.05, 200.0 + 0.2 * i, false);
    auto cloud = std::make_shared<PointCloud>(*stray.cloud);
    cloud->push(9.99F, 0.06F * float(i), 0.6F, 0, 0, 0);
    stray.cloud = cloud;
    EXPECT_GT(meter.look(stray, geometry)->distance_m, 1.0);
  }
}

TEST(Clearance, HasAWordForEachSide) {
  EXPECT_STREQ(sideWord(0.8), "ahead left");
  EXPECT_STREQ(sideWord(-1.6), "right");
  EXPECT_STREQ(sideWord(M_PI), "behind");
  EXPECT_STREQ(sideWord(-M_PI), "behind");
  EXPECT_STREQ(sideWord(-2.4), "behind right");
}

TEST_F(StationTest, TheDriversFiguresAreThoseOfTheRobotAndGoWithIt) {
  status.X_map_base = {1.234, -0.4, 12.3 * kDeg};
  status.twist = {0.3, 0.4, 0.0};
  feed();
  SceneTile tile(ui, models, RobotGeometry{}, false);
  const PoseChip& chip = *tile.poseChip();
  EXPECT_EQ(chip.pose(), "x +1.23 m  y −0.40 m  yaw +12°");
  EXPECT_EQ(chip.drive(), "0.50 m/s · nearest –") << "one point is no obstacle";
  const QSize before = chip.size();
  status.X_map_base = {-12.345, -0.001, -179.6 * kDeg};
  feed();
  EXPECT_EQ(chip.pose(), "x −12.35 m  y +0.00 m  yaw −180°");
  EXPECT_EQ(chip.size(), before);
  PoseChip near(ui, models);
  near.show(Clearance{0.004, 0.8});
  EXPECT_EQ(near.drive(), "0.50 m/s · TOUCHING ahead left");
  link.time.advanceBy(std::chrono::seconds(2));
  EXPECT_EQ(chip.pose(), "x – m  y – m  yaw –°") << "nobody knows";
  EXPECT_EQ(chip.drive(), "– m/s · nearest –");
}

}  // namespace
}  // namespace kiln::gui
