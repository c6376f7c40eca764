// What the robot adds to a recording beside what it publishes.
#include "robot/app/frame_tree.h"
#include "robot/app/robot_impl.h"

namespace kiln {
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
  sample.resets = belief.device_resets.value_or(0);
  recorder->devices(sample);
  if (++recorded_ticks % 2 == 0)  // every other tick is enough for what is drawn from it
    recorder->transforms(
        frameTree({now, robot, joints(sample.arm), sample.X_odom_base, tracked.X_map_base_3d}),
        tracked.X_map_base_3d, now);
}

}  // namespace kiln
