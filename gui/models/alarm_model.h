#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "gui/models/command_model.h"
#include "gui/models/model.h"

namespace kiln::gui {

/// Alarms of the robot and of the station itself. An alarm stays until it is both over and
/// acknowledged; a robot's alarm is acknowledged when the robot says so, not when it was asked.
class AlarmModel : public Model {
  Q_OBJECT
 public:
  struct Entry {
    Alarm alarm;
    bool own = false;                ///< raised by the station, e.g. "link lost"
    std::uint64_t asked = 0;         ///< nonce of an acknowledgement that is under way
    std::optional<Stamp> granted{};  ///< when it was answered with yes; the status follows
  };
  AlarmModel(Link& link, CommandModel& commands, QObject* parent = nullptr);
  /// Newest first.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// By weight: what is active and unacknowledged, what is active, what is over; in each the higher
  /// level and the newer one first.
  [[nodiscard]] std::vector<const Entry*> ranked() const;
  /// The first of them, for the strip: one that is over never hides an active one. nullptr if all
  /// is quiet.
  [[nodiscard]] const Entry* top() const;
  /// What the key acknowledges: the top one, else the next that nobody has; nullptr if none.
  [[nodiscard]] const Entry* next() const;
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
  /// One of the station's own has begun or is over, at once.
  void ownChanged(const kiln::Alarm& alarm);

 private:
  void take(const Alarm& alarm, bool own);
  void forgetFinished();
  void onAnswer(const TrackedCommand& command);
  CommandModel& commands_;
  std::vector<Entry> entries_;
};

}  // namespace kiln::gui
