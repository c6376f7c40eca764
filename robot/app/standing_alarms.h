#pragma once

#include <string>

#include "common/core/stamp.h"
#include "robot/app/alarm_book.h"
#include "robot/safety/stop_latch.h"

namespace kiln {

/// @param silent  silentLidar(): "no scan for 2.1 s"; empty: it delivers.
void setLidarAlarm(AlarmBook& alarms, const std::string& silent, Stamp now);
/// The motion watch has stopped the robot: nobody pressed STOP, so somebody must be told. Over when
/// the STOP is cleared.
void setMotionWatchAlarm(AlarmBook& alarms, const StopLatch& stop, Stamp now);

}  // namespace kiln
