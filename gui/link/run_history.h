#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/model/command.h"
#include "common/model/mission.h"
#include "common/model/status.h"
#include "gui/link/visit_log.h"

namespace kiln::gui {

/// What a stretch of a lane means; the view chooses the colour.
enum class SpanLook : std::uint8_t { Plain, Active, Manual, Caution, Fault };

struct HistorySpan {
  Stamp from, to;
  std::string text;
  SpanLook look = SpanLook::Plain;
  std::string key;  ///< what goes on while this stays the same; `text` is that of its beginning
};

struct HistorySample {
  Stamp stamp;
  double value = 0.0;
};
using HistorySeries = std::deque<HistorySample>;

/// A discrete command that a robot got, by whomever.
struct HistoryCommand {
  Stamp sent;  ///< by its sender's word, robot time
  std::string client_id, operator_name, name;
  std::uint64_t nonce = 0;
  std::optional<AckOutcome> outcome{};  ///< the newest answer
  std::string reason{};
};

/// A run along its time axis, from what the robot told in the order of time. Where it was not heard
/// for longer than kGap_s there is nothing. A value; confined to one thread at a time.
class RunHistory {
 public:
  enum Lane { Mode, Stop, Alarms, Macros, Actuators };
  static constexpr int kLanes = 5;
  static constexpr double kGap_s = 1.5;

  /// Its plotted figures become curves; shares (0 to 1, without a unit: the duty of a pump) say what
  /// runs in the lane Actuators.
  void setMission(const MissionInfo& info);
  void add(const RobotStatus& status);
  void add(const FsmStatus& status);
  /// Of all alarms those that stand at `now`; one for the others: the highest level, the oldest.
  void addAlarms(Stamp now, const std::vector<Alarm>& alarms);
  void add(const Command& command);
  void add(const CommandAck& ack);
  void forgetBefore(Stamp limit);

  [[nodiscard]] const std::vector<HistorySpan>& lane(Lane lane) const {
    return lanes_[static_cast<std::size_t>(lane)];
  }
  [[nodiscard]] const std::vector<Visit>& visits() const { return visits_.visits(); }
  /// How long the machine was held between two times.
  [[nodiscard]] Duration paused(Stamp from, Stamp to) const;
  [[nodiscard]] const std::vector<HistoryCommand>& commands() const { return commands_; }
  /// Of a plotted figure; empty for another.
  [[nodiscard]] const HistorySeries& figure(const std::string& id) const;
  /// Norm of the tool force, newton.
  [[nodiscard]] const HistorySeries& armForceN() const { return force_; }
  /// First and newest status; both Stamp{} before the first.
  [[nodiscard]] Stamp start() const { return start_; }
  [[nodiscard]] Stamp end() const { return end_; }

 private:
  struct Wanted {
    std::string text;  ///< empty: nothing
    SpanLook look = SpanLook::Plain;
    std::string key{};  ///< empty: the text
  };
  void goOn(Lane lane, Stamp now, const Wanted& wanted);
  [[nodiscard]] std::string running(const RobotStatus& status) const;
  void addSamples(const RobotStatus& status);

  std::array<std::vector<HistorySpan>, kLanes> lanes_;
  std::array<bool, kLanes> open_{};
  VisitLog visits_;
  std::vector<std::pair<Stamp, Stamp>> pauses_;
  bool machine_paused_ = false;
  std::vector<HistoryCommand> commands_;
  std::vector<FigureSpec> duties_;
  std::map<std::string, HistorySeries> figures_;
  HistorySeries force_;
  Stamp start_, end_;
};

/// What goes on at `at`; nullptr: nothing.
[[nodiscard]] const HistorySpan* spanAt(const std::vector<HistorySpan>& spans, Stamp at);
/// The newest sample at or before `at`, if it is no older than `reach_s`; nullopt: none.
[[nodiscard]] std::optional<double> sampleAt(const HistorySeries& series, Stamp at, double reach_s);

}  // namespace kiln::gui
