#include "robot/app/alarm_book.h"

#include <algorithm>

#include "common/core/log.h"

namespace kiln {

void AlarmBook::set(const std::string& id, bool active, AlarmLevel level, const std::string& text,
                    const std::string& action, Stamp now) {
  const auto found = alarms_.find(id);
  if (!active) {
    if (found == alarms_.end()) return;
    found->second.active = false;
    if (found->second.acknowledged) alarms_.erase(found);
    return;
  }
  if (found != alarms_.end() && found->second.active) {
    found->second.text = text;
    return;
  }
  alarms_[id] = Alarm{id, level, text, action, now, true, false};
  if (level == AlarmLevel::Advisory) {
    logger("alarm")->warn("{}: {}", id, text);
  } else {
    logger("alarm")->error("{}: {}; {}", id, text, action);
  }
}

bool AlarmBook::acknowledge(const std::string& id) {
  const auto found = alarms_.find(id);
  if (found == alarms_.end()) return false;
  found->second.acknowledged = true;
  if (!found->second.active) alarms_.erase(found);
  return true;
}

std::vector<Alarm> AlarmBook::list() const {
  std::vector<Alarm> out;
  for (const auto& [id, alarm] : alarms_) out.push_back(alarm);
  std::stable_sort(out.begin(), out.end(),
                   [](const Alarm& a, const Alarm& b) { return a.since < b.since; });
  return out;
}

}  // namespace kiln
