#pragma once

#include <memory>

#include "robot/skills/macro_runner.h"
#include "robot/skills/skill.h"

namespace kiln {

/// One running step. Started by its constructor's caller, polled at 50 Hz, cancelled by abort().
class MacroStepRun {
 public:
  virtual ~MacroStepRun() = default;
  virtual void start(Stamp now) = 0;
  [[nodiscard]] virtual SkillStatus poll(Stamp now) = 0;
  /// Leaves the defined state: arm holds, pumps off.
  virtual void abort(Stamp now) = 0;
};

[[nodiscard]] std::unique_ptr<MacroStepRun> makeMacroStep(const MacroStep& step,
                                                          const MacroRunnerConfig& config,
                                                          MacroRunner::Parts& parts);
/// "aim at place 1", "spray 20 s hourglass".
[[nodiscard]] std::string stepText(const MacroStep& step);

}  // namespace kiln
