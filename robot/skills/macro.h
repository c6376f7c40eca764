#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "common/core/stamp.h"
#include "robot/skills/skill.h"

namespace kiln {

/// What the steps of a macro take, reckoned.
struct MacroEstimate {
  double duration_s = 0.0;
  std::map<std::string, double> uses;  ///< by unit: {"l": 1.6}
};

/// One step of a macro: its keys as they stand in YAML, and how it is carried out. Started, polled
/// at 50 Hz, ended by abort(); may then be started again or resumed. Confined to the mission
/// thread.
class MacroStep {
 public:
  virtual ~MacroStep() = default;
  /// The keys of its kind, `do` excepted.
  virtual void visit(ConfigArchive& a) = 0;
  /// What the visitor cannot see: "'place' is missing"; empty: nothing.
  [[nodiscard]] virtual std::string problem() const { return {}; }
  /// For the operator: "arm to park".
  [[nodiscard]] virtual std::string text() const = 0;
  /// Adds what it takes.
  virtual void addTo(MacroEstimate& estimate) const = 0;

  virtual void start(Stamp now) = 0;
  /// After abort(): goes on with what was left, where that makes a difference.
  virtual void resume(Stamp now) { start(now); }
  [[nodiscard]] virtual SkillStatus poll(Stamp now) = 0;
  /// Leaves the defined state: what it moved holds, what it switched on is off.
  virtual void abort(Stamp now) = 0;
};

/// A word that may stand behind `do`. The robot brings some (robotMacroSteps()), a mission more
/// (Mission::macroSteps()).
struct MacroStepKind {
  std::string name;
  std::function<std::unique_ptr<MacroStep>()> make;
};
using MacroStepKinds = std::vector<MacroStepKind>;

/// A fallback by hand: a list of steps that runs on the robot while the operator holds it.
struct Macro {
  std::string name;  ///< "arm park"
  std::string doc;
  std::string place;  ///< start condition: the base stands at this place's work pose; empty = any
  double start_tolerance_m = 0.10;
  double start_tolerance_deg = 5.0;
  std::vector<std::unique_ptr<MacroStep>> steps;
  void visit(ConfigArchive& a, const MacroStepKinds& kinds);
  /// What the visitor cannot see: steps that lack something.
  [[nodiscard]] Result<void> validate(const std::string& file) const;
};

/// All *.yaml of the folders, by file name. Error with file:line for the first one that is wrong,
/// or for a name that two files share.
[[nodiscard]] Result<std::vector<Macro>> loadMacros(const std::vector<std::string>& folders,
                                                    const MacroStepKinds& kinds);

}  // namespace kiln
