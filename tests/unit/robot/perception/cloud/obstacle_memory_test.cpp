#include "robot/perception/cloud/obstacle_memory.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "tests/unit/robot/perception/cloud/scan_rig.h"

namespace kiln {
namespace {

Stamp at(double s) { return Stamp{} + fromSeconds(s); }

const Eigen::Isometry3d kLidar(Eigen::Translation3d(0, 0, 1.5));

/// Ring 7 (-1 deg) all around at 20 m, but for a post of 0.2 m that stands ahead at `range`.
PointCloud postAt(double range, double t, double post_from = 1.3) {
  PointCloud scan;
  scan.stamp = at(t);
  const double slope = std::tan(-1.0 * kDeg);
  for (int i = 0; i < 1800; ++i) {
    const double a = -M_PI + i * 2.0 * M_PI / 1800;
    const bool post = range > 0.0 && std::abs(a) * range < 0.1;
    const double r = post ? range : 20.0;
    const double z = post ? std::max(post_from, 1.5 + slope * r) : 1.5 + slope * r;
    scan.push(static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a)),
              static_cast<float>(z), 30, 7, 0.0f);
  }
  return scan;
}

void see(ObstacleMemory& memory, const PointCloud& scan, const Pose2& X_odom_base = {}) {
  memory.add(ObstacleMemory::observe({}, scan, kLidar), X_odom_base);
}

TEST(ObstacleMemory, BelievesAfterTwoScansAndForgetsWhatIsSeenThrough) {
  ObstacleMemory memory({});
  EXPECT_EQ(memory.snapshot(), nullptr);
  see(memory, postAt(3.0, 0.0));
  EXPECT_TRUE(memory.snapshot()->points.empty()) << "one scan may be noise";
  see(memory, postAt(3.0, 0.1));
  ASSERT_FALSE(memory.snapshot()->points.empty());
  for (const auto& p : memory.snapshot()->points) EXPECT_NEAR(p.p_odom.x(), 3.0, 0.1);
  see(memory, postAt(-1, 0.2));
  EXPECT_FALSE(memory.snapshot()->points.empty());
  see(memory, postAt(-1, 0.3));
  EXPECT_TRUE(memory.snapshot()->points.empty()) << "the person has gone on";
}

TEST(ObstacleMemory, KeepsWhatHasComeBelowTheLowestBeamAndMovesItWithTheRobot) {
  ObstacleMemory memory({});
  see(memory, postAt(3.0, 0.0));
  see(memory, postAt(3.0, 0.1));
  const std::size_t known = memory.snapshot()->points.size();
  // The robot has driven on by 2 m; 1 m ahead of it the post lies 11 deg below the only beam.
  for (double t = 0.2; t < 5.0; t += 0.1) {
    PointCloud scan = postAt(-1, t);
    see(memory, scan, {2.2, 0, 0});
  }
  EXPECT_EQ(memory.snapshot()->points.size(), known);
  see(memory, postAt(-1, 40.0), {2.2, 0, 0});
  EXPECT_TRUE(memory.snapshot()->points.empty()) << "too long ago";
}

TEST(ObstacleMemory, InTheKitchenOnlyWhatStandsThereIsRemembered) {
  ScanRig rig(4);
  const Vector6d q = RobotGeometry::radians(rig.robot.q_drive_deg);
  ObstacleMemory memory({});
  const auto motion = [&](double t) {
    return ScanRig::Motion{{2.0 + 0.8 * t, 0.05, 0.0}, q};  // through the door
  };
  for (double t = 0.1; t < 6.0; t += 0.2) {
    const auto scan = rig.scan(t, motion);
    const PointCloud prepared = rig.prepare(*scan, motion);
    const Eigen::Isometry3d X_base_lidar =
        rig.robot.X_base_flange(q) * rig.robot.X_flange_lidar.pose();
    memory.add(ObstacleMemory::observe({}, prepared, X_base_lidar),
               motion(toSeconds(scan->stamp)).X_map_base);
  }
  ASSERT_NE(memory.snapshot(), nullptr);
  EXPECT_GT(memory.snapshot()->points.size(), 500u);
  // Free way between the door's jambs and ahead: not one point of ground or robot.
  int in_the_way = 0;
  for (const auto& p : memory.snapshot()->points) {
    const Eigen::Vector3f& x = p.p_odom;
    const bool way = x.x() > 0.5f && x.x() < 9.5f && std::abs(x.y()) < 1.0f;
    in_the_way += way ? 1 : 0;
  }
  EXPECT_EQ(in_the_way, 0);
}

}  // namespace
}  // namespace kiln
