#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/geom/pose.h"
#include "common/model/status.h"
#include "robot/skills/macro.h"

namespace kiln {

/// Runs macros while the operator holds them. Letting go is a stop: the step that runs is aborted;
/// so is cancel(), a failed step and a change of the safety epoch between steps.
/// Holding the same macro again goes on with the step that was interrupted, unless a restart is
/// asked for. A macro that has ended, or whose start was refused, is over for this press: its
/// caller ends the hold when running() turns false (Authority::endHold). Confined to the mission
/// thread.
class MacroRunner {
 public:
  struct Parts {
    std::function<Pose2()> pose;  ///< newest X_map_base
    /// Where the base works on a place; nullopt: there is none of that name.
    std::function<std::optional<Pose2>(const std::string& place)> work_pose;
    std::function<std::uint64_t()> safety_epoch;  ///< SafetyEpoch::value
  };
  MacroRunner(Parts parts, std::vector<Macro> macros)
      : parts_(std::move(parts)), macros_(std::move(macros)) {}

  /// For the station: duration, start condition and what the steps add.
  [[nodiscard]] std::vector<MacroInfo> list() const;
  /// An accepted HoldMacro. Unknown names and start conditions that do not hold end up in
  /// status().last_result.
  void hold(const std::string& name, bool restart, Stamp now);
  /// At 50 Hz. @param held  the dead-man's word on HoldKind::Macro.
  void poll(Stamp now, bool held);
  /// No effect when nothing runs. @param reason  becomes the last result: "cancelled by Ann".
  void cancel(const std::string& reason) { finish(reason, false); }
  /// The hold has ended: holding the same macro again goes on where it was.
  void release() { finish("cancelled: released", true); }

  [[nodiscard]] bool running() const { return run_.has_value(); }
  [[nodiscard]] MacroStatus status() const;

 private:
  struct Run {
    const Macro* macro;
    std::size_t step = 0;
    std::uint64_t epoch = 0;
    bool resumes = false;    ///< the step was begun by an earlier press
    bool under_way = false;  ///< the step has been started
  };
  void begin(const Macro& macro, bool restart);
  void finish(const std::string& result, bool keep_place);
  [[nodiscard]] std::string startObjection(const Macro& macro) const;
  [[nodiscard]] const Macro* find(const std::string& name) const;

  Parts parts_;
  std::vector<Macro> macros_;
  std::optional<Run> run_;
  std::optional<Run> interrupted_;  ///< where the same macro goes on
  SkillStatus progress_;            ///< of the running step
  Stamp now_;
  std::string last_result_;
};

}  // namespace kiln
