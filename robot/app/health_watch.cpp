#include "robot/app/health_watch.h"

#include <algorithm>
#include <utility>

#include "common/core/log.h"

namespace kiln {
namespace {

constexpr const char* kAlarm = "fsm.blocked";

}  // namespace

void HealthWatch::remember(const RobotStatus& status) {
  const std::lock_guard lock(mutex_);
  last_ = status;
}

void HealthWatch::tick(Stamp now) {
  const std::string text = blocked_();
  if (text.empty()) {
    told_ = false;
    return;
  }
  if (!std::exchange(told_, true)) logger("health")->error("{}", text);
  RobotStatus status;
  {
    const std::lock_guard lock(mutex_);
    text_ = text;
    status = last_;
  }
  status.stamp = now;
  std::erase_if(status.alarms, [](const Alarm& alarm) { return alarm.id == kAlarm; });
  Alarm alarm;
  alarm.id = kAlarm;
  alarm.level = AlarmLevel::Warning;
  alarm.text = text;
  alarm.action = "press STOP and restart the daemon";
  alarm.since = now;
  status.alarms.push_back(std::move(alarm));
  publish_(std::move(status));
}

std::string HealthWatch::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(text_, {});
}

}  // namespace kiln
