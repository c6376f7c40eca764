#include "gui/models/alarm_model.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace kiln::gui {

namespace {
/// A status that left the robot before it had acted on the answer still shows the old state.
constexpr double kEcho_s = 1.0;

int rank(const AlarmModel::Entry& entry) {
  return entry.alarm.active ? (entry.alarm.acknowledged ? 1 : 2) : 0;
}
}  // namespace

AlarmModel::AlarmModel(Link& link, CommandModel& commands, QObject* parent)
    : Model(link, AgeLimits{}, parent), commands_(commands) {
  connect(&link, &Link::restarted, this, [this] {
    entries_.clear();
    touch();
  });
  connect(&commands_, &CommandModel::progressed, this, &AlarmModel::onAnswer);
  connect(&link, &Link::status, this, [this](const std::shared_ptr<const RobotStatus>& status) {
    // The robot tells of each until it is over and acknowledged, by whomever.
    std::erase_if(entries_, [&](const Entry& entry) {
      return !entry.own && std::none_of(status->alarms.begin(), status->alarms.end(),
                                        [&](const Alarm& a) { return a.id == entry.alarm.id; });
    });
    for (const Alarm& alarm : status->alarms) take(alarm, false);
    for (Entry& entry : entries_) {
      if (entry.granted && toSeconds(status->stamp - *entry.granted) > kEcho_s)
        entry = {entry.alarm, entry.own};
    }
    forgetFinished();
    arrived(status->stamp);
  });
}

std::vector<const AlarmModel::Entry*> AlarmModel::ranked() const {
  std::vector<const Entry*> out;
  for (const Entry& entry : entries_) out.push_back(&entry);
  std::stable_sort(out.begin(), out.end(), [](const Entry* a, const Entry* b) {
    return std::tuple(rank(*a), a->alarm.level) > std::tuple(rank(*b), b->alarm.level);
  });
  return out;
}

const AlarmModel::Entry* AlarmModel::top() const {
  return entries_.empty() ? nullptr : ranked().front();
}

const AlarmModel::Entry* AlarmModel::next() const {
  for (const Entry* entry : ranked())
    if (!entry->alarm.acknowledged && entry->asked == 0) return entry;
  return nullptr;
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
  return static_cast<int>(std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) {
    return !e.alarm.acknowledged && e.asked == 0;
  }));
}

void AlarmModel::acknowledge(const QString& id) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return e.alarm.id == id.toStdString() && !e.alarm.acknowledged && e.asked == 0;
  });
  if (found == entries_.end()) return;
  if (found->own) {
    found->alarm.acknowledged = true;
  } else {
    const std::uint64_t nonce =
        commands_.send(AcknowledgeAlarm{found->alarm.id}, tr("acknowledge %1").arg(id));
    const TrackedCommand* command = commands_.find(nonce);
    if (command && !command->bad()) found->asked = nonce;
  }
  forgetFinished();
  touch();
}

void AlarmModel::onAnswer(const TrackedCommand& command) {
  for (Entry& entry : entries_) {
    if (entry.asked == 0 || entry.asked != command.nonce || command.open()) continue;
    if (command.bad())
      entry = {entry.alarm, entry.own};
    else
      entry.granted = link().robotNow().value_or(stamp());
    touch();
  }
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
    if (!std::exchange(found->alarm.active, false)) return;
    emit ownChanged(found->alarm);
  } else {
    if (found != entries_.end()) entries_.erase(found);
    alarm.since = link().robotNow().value_or(stationNow());
    take(alarm, true);
    emit ownChanged(alarm);
  }
  forgetFinished();
  touch();
}

void AlarmModel::take(const Alarm& alarm, bool own) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return e.own == own && e.alarm.id == alarm.id;
  });
  if (found == entries_.end()) {
    entries_.insert(entries_.begin(), Entry{alarm, own});
    return;
  }
  const bool again = alarm.active && alarm.since > found->alarm.since;
  found->alarm = alarm;
  if (alarm.acknowledged) *found = {alarm, own};
  if (!again) return;
  entries_.erase(found);
  entries_.insert(entries_.begin(), Entry{alarm, own});
}

void AlarmModel::forgetFinished() {
  std::erase_if(entries_, [](const Entry& e) { return !e.alarm.active && e.alarm.acknowledged; });
}

}  // namespace kiln::gui
