#include "robot/planning/base_path/base_path.h"

#include <cmath>

#include "tests/unit/robot/planning/arm_motion/bob.h"

namespace kiln {
namespace {

std::vector<Pose2> posesOf(const std::vector<GroundPoseConfig>& configs) {
  std::vector<Pose2> out;
  for (const GroundPoseConfig& config : configs) out.push_back(config.pose());
  return out;
}

TEST(BasePath, StraightLineKeepsSpeedAccelerationAndApproach) {
  const BasePath path({0, 0, 0}, {{5, 0, 0}}, {});
  const double dt = 0.01;
  double last_speed = 0.0;
  for (double t = 0; t <= path.duration(); t += dt) {
    const BasePath::Point p = path.at(t);
    const double speed = std::hypot(p.v_map.vx_mps, p.v_map.vy_mps);
    ASSERT_LE(speed, 1.0 + 1e-6);
    ASSERT_LE(std::abs(speed - last_speed) / dt, 0.5 + 1e-3);
    if (p.X_map_base.x_m > 5.0 - 0.4) {
      ASSERT_LE(speed, 0.3 + 1e-3);
    }
    last_speed = speed;
  }
  const BasePath::Point end = path.at(path.duration());
  EXPECT_NEAR(end.X_map_base.x_m, 5.0, 1e-9);
  EXPECT_NEAR(end.v_map.vx_mps, 0.0, 1e-9);
}

TEST(BasePath, PassesCornersWithinTheirRadiusWithoutStopping) {
  const BasePath path({0, 0, 0}, {{3, 0, 0}, {3, 3, M_PI / 2}}, {});
  double nearest = INFINITY, slowest = INFINITY;
  for (double t = 0; t <= path.duration(); t += 0.01) {
    const BasePath::Point p = path.at(t);
    const double to_corner = std::hypot(p.X_map_base.x_m - 3, p.X_map_base.y_m);
    nearest = std::min(nearest, to_corner);
    if (to_corner < 0.4) slowest = std::min(slowest, std::hypot(p.v_map.vx_mps, p.v_map.vy_mps));
  }
  EXPECT_LT(nearest, 0.3);
  EXPECT_GT(nearest, 0.02);
  EXPECT_GT(slowest, 0.15);
}

TEST(BasePath, TurnsOnTheSpotAndTheShortWay) {
  const BasePath path({1, 1, 170 * M_PI / 180}, {{1, 1, -170 * M_PI / 180}}, {});
  const BasePath::Point middle = path.at(0.5 * path.duration());
  EXPECT_NEAR(std::abs(middle.X_map_base.yaw_rad), M_PI, 0.02);
  EXPECT_GT(middle.v_map.wz_radps, 0.0);
  EXPECT_NEAR(path.at(path.duration()).X_map_base.yaw_rad, -170 * M_PI / 180, 1e-9);
}

TEST(BasePath, NamesTheWaypointAhead) {
  const BasePath path({0, 0, 0}, {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {});
  EXPECT_EQ(path.nextWaypoint(0.0), 0);
  EXPECT_EQ(path.nextWaypoint(1.5), 1);
  EXPECT_EQ(path.nextWaypoint(3.0), 2);
}

TEST(BasePath, TheKitchensWaypointsAreFreeForTheFootprint) {
  const ArenaMap arena = loadKitchen();
  const RobotGeometry robot = loadBob();
  const auto boxes = kitchenBoxes(arena);
  std::vector<Pose2> tour = posesOf(arena.entry_path);
  const Pose2 hub = tour.back();
  for (const FirePlaceConfig& place : loadKitchenSite().places) {
    for (const Pose2& via : posesOf(place.via)) tour.push_back(via);
    tour.push_back(place.work_pose.pose());
    tour.push_back(hub);
  }
  const BasePath path(arena.start.pose(), tour, {});
  const auto hit = firstObstacle(path, robot.length_m, robot.width_m, boxes);
  EXPECT_FALSE(hit.has_value()) << *hit;
}

TEST(BasePath, NamesTheWallThatAWayLeadsThrough) {
  const ArenaMap arena = loadKitchen();
  const BasePath path({0, 3, 0}, {{8, 3, 0}}, {});
  const auto hit = firstObstacle(path, 1.9, 1.4, kitchenBoxes(arena));
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(*hit, "west wall north");
}

}  // namespace
}  // namespace kiln
