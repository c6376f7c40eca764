#pragma once

#include <QString>
#include <vector>

#include "gui/models/command_tracker.h"
#include "gui/models/model.h"

namespace kiln::gui {

/// Alarms of the robot and of the station itself. An alarm stays until it is both over and
/// acknowledged.
class AlarmModel : public Model {
  Q_OBJECT
 public:
  struct Entry {
    Alarm alarm;
    bool own = false;  ///< raised by the station, e.g. "link lost"
  };
  AlarmModel(Link& link, CommandTracker& commands, QObject* parent = nullptr);
  /// Newest first.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// What the strip shows: the newest unacknowledged of the highest level; nullptr if all is quiet.
  [[nodiscard]] const Entry* top() const;
  /// The first of the alarms that still stand: with a flood the likely cause. nullptr with fewer
  /// than two.
  [[nodiscard]] const Entry* firstOut() const;
  [[nodiscard]] int activeCount() const;
  [[nodiscard]] int unacknowledgedCount() const;
  void acknowledge(const QString& id);
  /// Raise, update or end an alarm of the station itself.
  void setOwn(const QString& id, AlarmLevel level, bool active, const QString& text,
              const QString& action);

 signals:
  void raised(const kiln::Alarm& alarm);  ///< a new one, at once

 private:
  void take(const Alarm& alarm, bool own);
  void forgetFinished();
  CommandTracker& commands_;
  std::vector<Entry> entries_;
};

}  // namespace kiln::gui
