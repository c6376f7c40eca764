#pragma once

#include <deque>
#include <memory>

#include "gui/link/run_history.h"
#include "gui/models/alarm_model.h"
#include "gui/models/command_model.h"
#include "gui/models/model.h"

namespace kiln::gui {

/// The run along its time axis: of a live robot the last kWindow_s as this station has seen them,
/// of a recording all of it.
class HistoryModel : public Model {
  Q_OBJECT
 public:
  static constexpr double kWindow_s = 900.0;
  HistoryModel(Link& link, const AlarmModel& alarms, const CommandModel& commands,
               QObject* parent = nullptr);
  /// States are in it only if it is whole: FsmModel has those of a live robot.
  [[nodiscard]] const RunHistory& run() const { return whole_ ? *whole_ : run_; }
  /// Of a recording, as far as it has been read.
  [[nodiscard]] bool whole() const { return whole_ != nullptr; }
  /// This station's own of a live robot; of a recording everybody's.
  [[nodiscard]] const std::deque<TrackedCommand>& commands() const;
  /// Heartbeat round trip, seconds; NaN while there is no link. None in a recording.
  [[nodiscard]] const HistorySeries& rttS() const { return rtt_; }
  /// Takes in which alarms stand; by StationModels, at 5 Hz.
  void watchAlarms();

 private:
  void addRoundTrip(const LinkHealth& health);
  void setWhole(std::shared_ptr<const RunHistory> whole);
  const AlarmModel& alarms_;
  const CommandModel& tracker_;
  RunHistory run_;
  std::shared_ptr<const RunHistory> whole_;
  std::deque<TrackedCommand> recorded_;
  HistorySeries rtt_;
};

}  // namespace kiln::gui
