// What the robot adds to a recording beside what it publishes.
#include "common/geom/frames.h"
#include "robot/app/robot_impl.h"

namespace kiln {
namespace {

/// @param X_map_base  on the ground as it slopes: odometry is planar, so the slope stands in map ->
/// odom.
std::vector<foxglove::FrameTransform> frameTree(const DeviceSample& sample,
                                                const RobotGeometry& robot,
                                                const Eigen::Isometry3d& X_map_base) {
  std::vector<foxglove::FrameTransform> tree;
  const auto add = [&](const char* parent, const char* child, const Eigen::Isometry3d& X) {
    tree.push_back({sample.stamp, parent, child, X});
  };
  add(frames::kMap, frames::kOdom, X_map_base * toIsometry(inverse(sample.X_odom_base)));
  add(frames::kOdom, frames::kBase, toIsometry(sample.X_odom_base));
  add(frames::kBase, frames::kArmBase, robot.X_base_armbase.pose());
  add(frames::kBase, frames::kOperatorCamera, robot.X_base_operatorcamera.pose());
  if (!sample.arm) return tree;
  add(frames::kBase, frames::kFlange, robot.X_base_flange(sample.arm->q));
  add(frames::kFlange, frames::kLidar, robot.X_flange_lidar.pose());
  add(frames::kFlange, frames::kThermal, robot.X_flange_thermal.pose());
  add(frames::kFlange, frames::kRgb, robot.X_flange_rgb.pose());
  add(frames::kFlange, frames::kNozzle, robot.X_flange_nozzle.pose());
  add(frames::kFlange, frames::kTool, robot.X_flange_tool.pose());
  return tree;
}

}  // namespace

void Robot::Impl::record(Stamp now) {
  RunRecorder* recorder = options.recorder;
  if (!recorder || !recorder->on()) return;
  DeviceSample sample;
  sample.stamp = now;
  sample.arm = devices.arm.state();
  sample.base = devices.base.state();
  sample.pumps = devices.pumps.state();
  sample.X_odom_base = base.tracking().X_odom_base;
  sample.X_map_odom = tracked.X_map_odom;
  sample.resets = resets_seen;
  recorder->devices(sample);
  if (++recorded_ticks % 2 == 0)  // every other tick is enough for what is drawn from it
    recorder->transforms(frameTree(sample, robot, tracked.X_map_base_3d), tracked.X_map_base_3d,
                         now);
}

}  // namespace kiln
