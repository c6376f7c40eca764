#include "robot/app/scan_preparation.h"

#include <utility>

#include "robot/perception/cloud/range_bias.h"
#include "robot/perception/cloud/undistort.h"

namespace kiln {
namespace {

constexpr int kTrackSamples = 26;  // every 4 ms of a revolution at 10 Hz: joints come each 8 ms

/// Joint angles over the scan, and the LiDAR's pose in the base frame of the scan's first point.
struct ScanMotion {
  ArmTrack arm;
  PoseTrack X_base_lidar;
};

ScanMotion motionDuring(const PointCloud& scan, const RobotGeometry& robot,
                        const StateHistory& history) {
  ScanMotion motion;
  const auto first = history.at(scan.stamp);
  if (!first) return motion;
  const Duration length = scanEnd(scan) - scan.stamp;
  const Pose2 X_base0_odom = inverse(first->X_odom_base);
  const Eigen::Isometry3d X_flange_lidar = robot.X_flange_lidar.pose();
  for (int i = 0; i < kTrackSamples; ++i) {
    const Stamp t = scan.stamp + length * i / (kTrackSamples - 1);
    const auto sample = history.at(t);
    if (!sample) break;
    motion.arm.push(t, sample->q);
    motion.X_base_lidar.push(t, toIsometry(X_base0_odom * sample->X_odom_base) *
                                    robot.X_base_flange(sample->q) * X_flange_lidar);
  }
  return motion;
}

}  // namespace

Stamp scanEnd(const PointCloud& scan) {
  return scan.stamp + fromSeconds(scan.time_offset_s.empty() ? 0.0 : scan.time_offset_s.back());
}

PreparedScan prepareScan(const PointCloud& scan, const RobotGeometry& robot,
                         const StateHistory& history, const SelfFilter& self_filter) {
  ScanMotion motion = motionDuring(scan, robot, history);
  auto filtered = self_filter.filter(scan, motion.arm);
  correctRanges(filtered.cloud, robot.lidar_range_bias_m);
  if (motion.X_base_lidar.empty())  // no robot attached: show the scan as it came
    return {std::make_shared<PointCloud>(std::move(filtered.cloud)), nullptr};
  auto cloud = std::make_shared<PointCloud>(undistort(filtered.cloud, motion.X_base_lidar, "base"));
  return {std::move(cloud), std::make_shared<PoseTrack>(std::move(motion.X_base_lidar))};
}

}  // namespace kiln
