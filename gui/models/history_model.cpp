#include "gui/models/history_model.h"

#include <cmath>

#include "common/client/command_tracker.h"

namespace kiln::gui {

namespace {
/// "change_state" -> "change state · Ann".
QString labelOf(const HistoryCommand& command) {
  QString label = QString::fromStdString(command.name).replace(QLatin1Char('_'), QLatin1Char(' '));
  if (!command.operator_name.empty())
    label += QStringLiteral(" · ") + QString::fromStdString(command.operator_name);
  return label;
}
}  // namespace

HistoryModel::HistoryModel(Link& link, const AlarmModel& alarms, const CommandModel& commands,
                           QObject* parent)
    : Model(link, AgeLimits{}, parent), alarms_(alarms), tracker_(commands) {
  connect(&link, &Link::history, this, &HistoryModel::setWhole);
  if (link.readOnly()) return;  // what is played comes as a whole
  connect(&link, &Link::missionInfo, this, [this](const std::shared_ptr<const MissionInfo>& info) {
    run_.setMission(*info);
    touch();
  });
  connect(&link, &Link::status, this, [this](const std::shared_ptr<const RobotStatus>& status) {
    run_.add(*status);
    run_.forgetBefore(status->stamp - fromSeconds(kWindow_s));
    arrived(status->stamp);
  });
  connect(&link, &Link::health, this, &HistoryModel::addRoundTrip);
}

void HistoryModel::addRoundTrip(const LinkHealth& health) {
  const auto now = link().robotNow();
  if (!now || (!rtt_.empty() && *now <= rtt_.back().stamp)) return;
  const bool linked = health.state == LinkState::Up || health.state == LinkState::Degraded;
  rtt_.push_back({*now, linked && health.rtt_s >= 0 ? health.rtt_s : NAN});
  while (toSeconds(*now - rtt_.front().stamp) > kWindow_s) rtt_.pop_front();
  touch();
}

void HistoryModel::watchAlarms() {
  const auto now = link().robotNow();
  if (!now || link().readOnly()) return;
  std::vector<Alarm> alarms;
  for (const AlarmModel::Entry& entry : alarms_.entries()) alarms.push_back(entry.alarm);
  run_.addAlarms(*now, alarms);
  touch();
}

const std::deque<TrackedCommand>& HistoryModel::commands() const {
  return whole_ ? recorded_ : tracker_.commands();
}

void HistoryModel::setWhole(std::shared_ptr<const RunHistory> whole) {
  whole_ = std::move(whole);
  recorded_.clear();
  for (const HistoryCommand& command : whole_->commands()) {
    TrackedCommand row;
    row.nonce = command.nonce;
    row.name = QString::fromStdString(command.name);
    row.label = labelOf(command);
    row.sent = command.sent;
    row.state = command.outcome ? stateOf(*command.outcome) : CommandState::Unknown;
    row.reason = QString::fromStdString(command.reason);
    recorded_.push_back(row);
  }
  touch();
}

}  // namespace kiln::gui
