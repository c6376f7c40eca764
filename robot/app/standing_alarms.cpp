#include "robot/app/standing_alarms.h"

#include "robot/safety/motion_watch.h"

namespace kiln {

void setLidarAlarm(AlarmBook& alarms, const std::string& silent, Stamp now) {
  alarms.set("lidar.silent", !silent.empty(), AlarmLevel::Warning, "LiDAR silent: " + silent,
             "check its cable and power; drive by the cameras only", now);
}

void setMotionWatchAlarm(AlarmBook& alarms, const StopLatch& stop, Stamp now) {
  const std::string source = stop.source();
  const bool stopped = stop.latched() && source.rfind(kMotionWatchSource, 0) == 0;
  alarms.set("base.motion_watch", stopped, AlarmLevel::Warning,
             "STOP by " + (stopped ? source : std::string()),
             "look at the wheels and at what the robot stands against, then clear the stop", now);
}

}  // namespace kiln
