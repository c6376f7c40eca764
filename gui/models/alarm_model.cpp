#include "gui/models/alarm_model.h"

#include <algorithm>

namespace kiln::gui {

AlarmModel::AlarmModel(Link& link, CommandTracker& commands, QObject* parent)
    : Model(link, AgeLimits{}, parent), commands_(commands) {
  connect(&link, &Link::restarted, this, [this] {
    entries_.clear();
    touch();
  });
  connect(&link, &Link::status, this, [this](const std::shared_ptr<const RobotStatus>& status) {
    for (Entry& entry : entries_) {
      const bool told = std::any_of(status->alarms.begin(), status->alarms.end(),
                                    [&](const Alarm& a) { return a.id == entry.alarm.id; });
      if (!entry.own && !told) entry.alarm.active = false;
    }
    for (const Alarm& alarm : status->alarms) take(alarm, false);
    forgetFinished();
    arrived(status->stamp);
  });
}

const AlarmModel::Entry* AlarmModel::top() const {
  const Entry* best = nullptr;
  for (const Entry& entry : entries_) {
    if (entry.alarm.acknowledged) continue;
    if (!best || entry.alarm.level > best->alarm.level) best = &entry;
  }
  return best;
}

const AlarmModel::Entry* AlarmModel::firstOut() const {
  const Entry* first = nullptr;
  int standing = 0;
  for (const Entry& entry : entries_) {
    if (!entry.alarm.active) continue;
    ++standing;
    if (!first || entry.alarm.since < first->alarm.since) first = &entry;
  }
  return standing >= 2 ? first : nullptr;
}

int AlarmModel::activeCount() const {
  return static_cast<int>(std::count_if(entries_.begin(), entries_.end(),
                                        [](const Entry& e) { return e.alarm.active; }));
}

int AlarmModel::unacknowledgedCount() const {
  return static_cast<int>(std::count_if(entries_.begin(), entries_.end(),
                                        [](const Entry& e) { return !e.alarm.acknowledged; }));
}

void AlarmModel::acknowledge(const QString& id) {
  for (Entry& entry : entries_) {
    if (entry.alarm.id != id.toStdString() || entry.alarm.acknowledged) continue;
    entry.alarm.acknowledged = true;
    if (!entry.own) commands_.send(AcknowledgeAlarm{entry.alarm.id}, tr("acknowledge"));
  }
  forgetFinished();
  touch();
}

void AlarmModel::setOwn(const QString& id, AlarmLevel level, bool active, const QString& text,
                        const QString& action) {
  const std::string key = id.toStdString();
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& e) { return e.own && e.alarm.id == key; });
  if (!active && found == entries_.end()) return;
  Alarm alarm{key, level, text.toStdString(), action.toStdString(), {}, active, false};
  if (found != entries_.end() && found->alarm.active && active) {
    found->alarm.text = alarm.text;  // the same alarm goes on: keep its time and acknowledgement
    found->alarm.level = level;
  } else if (!active) {
    found->alarm.active = false;
  } else {
    if (found != entries_.end()) entries_.erase(found);
    alarm.since = link().robotNow().value_or(stationNow());
    take(alarm, true);
  }
  forgetFinished();
  touch();
}

void AlarmModel::take(const Alarm& alarm, bool own) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return e.own == own && e.alarm.id == alarm.id;
  });
  if (found != entries_.end()) {
    const bool again = alarm.active && alarm.since > found->alarm.since;
    // Our own acknowledgement may be ahead of the robot's echo.
    const bool acknowledged = alarm.acknowledged || (found->alarm.acknowledged && !again);
    found->alarm = alarm;
    found->alarm.acknowledged = acknowledged;
    if (!again) return;
    const Entry entry = *found;
    entries_.erase(found);
    entries_.insert(entries_.begin(), entry);
  } else {
    entries_.insert(entries_.begin(), Entry{alarm, own});
  }
  emit raised(alarm);
}

void AlarmModel::forgetFinished() {
  std::erase_if(entries_, [](const Entry& e) { return !e.alarm.active && e.alarm.acknowledged; });
}

}  // namespace kiln::gui
