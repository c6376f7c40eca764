#include "robot/perception/cloud/undistort.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(Undistort, AStillPointSeenByAMovingLidarBecomesOnePoint) {
  // The LiDAR drives 1 m/s and turns 1 rad/s while it sees the same point 500 times in 0.1 s.
  const Eigen::Vector3d p(4, 2, 1);
  PoseTrack track;
  PointCloud scan;
  scan.stamp = Stamp{std::chrono::seconds(7)};
  scan.frame = "lidar";
  const auto pose = [](double t) { return makePose({t, 0, 0.5}, {0, 0, t}); };
  for (int i = 0; i <= 20; ++i) track.push(scan.stamp + fromSeconds(0.005 * i), pose(0.005 * i));
  for (int i = 0; i < 500; ++i) {
    const double t = 0.1 * i / 499;
    const Eigen::Vector3f l = (pose(t).inverse() * p).cast<float>();
    scan.push(l.x(), l.y(), l.z(), 9, 2, static_cast<float>(t));
  }
  const PointCloud still = undistort(scan, track, "base");
  EXPECT_EQ(still.frame, "base");
  ASSERT_EQ(still.size(), scan.size());
  for (std::size_t i = 0; i < still.size(); ++i) {
    // half an instant (0.8 ms) of motion at 1 m/s and 1 rad/s over 4.5 m
    EXPECT_NEAR((Eigen::Vector3d(still.x[i], still.y[i], still.z[i]) - p).norm(), 0.0, 0.005) << i;
    EXPECT_EQ(still.intensity[i], 9);
  }
}

TEST(Undistort, LidarInBaseFollowsTheJoints) {
  const RobotGeometry geometry;
  ArmTrack arm;
  PointCloud scan;
  scan.push(1, 0, 0, 0, 0, 0.1f);
  EXPECT_TRUE(lidarInBase(scan, geometry, arm).empty());
  Vector6d q = Vector6d::Zero();
  arm.push(Stamp{}, q);
  q[0] = 0.2;
  arm.push(Stamp{} + fromSeconds(0.1), q);
  const PoseTrack track = lidarInBase(scan, geometry, arm);
  const Eigen::Isometry3d turned =
      track.at(Stamp{}).inverse() * track.at(Stamp{} + fromSeconds(0.1));
  EXPECT_NEAR(rotationAngle(turned), 0.2, 1e-6);
}

}  // namespace
}  // namespace kiln
