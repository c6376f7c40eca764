// What the robot adds to a recording beside what it publishes.
#include "robot/app/frame_tree.h"
#include "robot/app/robot_reporting.h"

namespace kiln {

void RobotReporting::record(Stamp now) {
  RunRecorder* recorder = body_.options.recorder;
  if (!recorder || !recorder->on()) return;
  const TrackedPose& tracked = parts_.localization.tracked();
  DeviceSample sample;
  sample.stamp = now;
  sample.arm = body_.devices.arm.state();
  sample.base = body_.devices.base.state();
  sample.pumps = body_.pump_device.state();
  if (body_.devices.gripper) sample.gripper = body_.devices.gripper->state();
  if (body_.devices.storage) sample.storage = body_.devices.storage->state();
  sample.X_odom_base = body_.base.tracking().X_odom_base;
  sample.X_map_odom = tracked.X_map_odom;
  sample.resets = body_.belief.device_resets.value_or(0);
  recorder->devices(sample);
  if (++recorded_ticks_ % 2 == 0)  // every other tick is enough for what is drawn from it
    recorder->transforms(frameTree({now, body_.robot, joints(sample.arm), sample.X_odom_base,
                                    tracked.X_map_base_3d}),
                         tracked.X_map_base_3d, now);
}

}  // namespace kiln
