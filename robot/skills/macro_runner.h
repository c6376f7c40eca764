#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/model/status.h"
#include "common/robot_model/robot_geometry.h"
#include "robot/control/pump_controller.h"
#include "robot/scene/arena_map.h"
#include "robot/skills/aim/aim_solver.h"
#include "robot/skills/macro.h"
#include "robot/skills/motion.h"
#include "robot/skills/spray/spray_pattern.h"

namespace kiln {

class MacroStepRun;

struct MacroRunnerConfig {
  AimSolverConfig aim;
  SprayPatternConfig pattern;       ///< its half_width_deg comes from the macro
  double flow_lpm = 1.6;            ///< each pump, for the list's litres
  double tank_l = 5.0;              ///< each tank when full
  double arm_step_s = 6.0;          ///< what the list reckons for one arm motion
  double pump_check_after_s = 1.0;  ///< a pump without current by then fails the step
  void visit(ConfigArchive& a);
};

/// Runs macros while the operator holds them. Letting go is a stop: the arm decelerates and holds,
/// the pumps are off; so is cancel(), a failed step and a change of the safety epoch between steps.
/// Holding the same macro again goes on with the step that was interrupted, unless a restart is
/// asked for. A macro that has ended, or whose start was refused, is over for this press: its
/// caller ends the hold when running() turns false (Authority::endHold). Confined to the mission
/// thread.
class MacroRunner {
 public:
  struct Parts {
    const RobotGeometry& robot;
    const ArenaMap& arena;
    ArmMotion& arm;
    PumpController& pumps;
    SprayCalibration calibration;
    std::function<Pose2()> pose;  ///< newest X_map_base
    /// Newest measured X_base_flange; nullopt while the arm is silent.
    std::function<std::optional<Eigen::Isometry3d>()> flange;
    std::function<std::uint64_t()> safety_epoch;  ///< SafetyEpoch::value
  };
  MacroRunner(MacroRunnerConfig config, Parts parts, std::vector<Macro> macros);
  ~MacroRunner();

  /// For the station: duration, water and start condition.
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
    std::unique_ptr<MacroStepRun> step_run;
  };
  void start(const Macro& macro, std::size_t step);
  void finish(const std::string& result, bool keep_place);
  [[nodiscard]] std::string startObjection(const Macro& macro) const;
  [[nodiscard]] const Macro* find(const std::string& name) const;

  MacroRunnerConfig config_;
  Parts parts_;
  std::vector<Macro> macros_;
  std::optional<Run> run_;
  std::optional<Run> interrupted_;  ///< where the same macro goes on
  SkillStatus progress_;            ///< of the running step
  Stamp now_;
  std::string last_result_;
};

}  // namespace kiln
