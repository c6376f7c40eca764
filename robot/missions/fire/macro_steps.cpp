#include "robot/missions/fire/macro_steps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kMaxSpray_s = 120.0;  // what the pump controller allows in one run

class AimStep final : public ArmMacroStep {
 public:
  AimStep(const FireContext& context, const MacroConfig& config)
      : ArmMacroStep(context.devices.arm, config), context_(context) {}
  void visit(ConfigArchive& a) override {
    a.field("place", place_, "fire place of the arena");
    a.field("standoff_m", standoff_m_, "m", 0.5, 1.2, "nozzle to plate");
  }
  [[nodiscard]] std::string problem() const override {
    return place_.empty() ? "aim: 'place' is missing" : "";
  }
  [[nodiscard]] std::string text() const override { return "aim at " + place_; }

 private:
  Result<void> begin(Stamp now) override {
    const FirePlaceConfig* place = context_.site.place(place_);
    if (!place) return makeError(ErrorCode::NotFound, "the arena has no fire place '{}'", place_);
    const double yaw = place->facing_deg * kDeg;
    const AimTarget target{{place->plate_xyz_m[0], place->plate_xyz_m[1], place->plate_xyz_m[2]},
                           {std::cos(yaw), std::sin(yaw), 0.0},
                           context_.site.recess_m};
    AimSolverConfig solver = context_.config.aim.solver;
    solver.standoff_m = std::clamp(standoff_m_, solver.min_standoff_m, solver.max_standoff_m);
    const auto solution = solveAim(target, solver, context_.calibration, flowScale(),
                                   [this](const Eigen::Isometry3d& X_map_nozzle) -> Result<void> {
                                     const auto q =
                                         arm_.check(context_.flangeForNozzle(X_map_nozzle));
                                     if (!q) return tl::make_unexpected(q.error());
                                     return {};
                                   });
    if (!solution) return tl::make_unexpected(solution.error());
    arm_.startPose(context_.flangeForNozzle(solution->X_map_nozzle), now);
    return {};
  }
  [[nodiscard]] double flowScale() const {
    const auto& tanks = context_.devices.pumps.tracking().tank_l_est;
    const double litres = std::accumulate(tanks.begin(), tanks.end(), 0.0);
    return context_.calibration.flowScale(litres / (2.0 * context_.config.spray.tank_l));
  }
  const FireContext& context_;
  std::string place_;
  double standoff_m_ = 0.8;
};

class SprayStep final : public MacroStep {
 public:
  explicit SprayStep(const FireContext& context) : context_(context) {}
  void visit(ConfigArchive& a) override {
    a.field("duty", duty_, "", 0.0, 1.0, "both pumps");
    a.field("seconds", seconds_, "s", 0.1, kMaxSpray_s, "from switching the pumps on");
    a.choice("pattern", pattern_, {"steady", "hourglass"}, "what the nozzle does meanwhile");
    if (pattern_ == "hourglass")
      a.field("tilt_deg", tilt_deg_, "deg", 0.1, 15.0, "of the nozzle to either side");
  }
  [[nodiscard]] std::string text() const override {
    return fmt::format("spray {:.0f} s {}", seconds_, pattern_);
  }
  void addTo(MacroEstimate& estimate) const override {
    estimate.duration_s += seconds_;
    estimate.uses["l"] += context_.config.spray.flow_lpm / 60.0 * duty_ * seconds_;
  }

  void start(Stamp now) override {
    timer_.start(now);
    beginPress(now);
  }
  void resume(Stamp now) override {
    timer_.resume(now);
    beginPress(now);
  }
  [[nodiscard]] SkillStatus poll(Stamp now) override {
    const double elapsed_s = timer_.elapsedS(now);
    SkillStatus status{SkillPhase::Running, std::min(1.0, elapsed_s / seconds_),
                       fmt::format("{:.0f} s to go", std::max(0.0, seconds_ - elapsed_s)), ""};
    if (elapsed_s >= seconds_) {
      abort(now);
      status.phase = SkillPhase::Done;
      return status;
    }
    const PumpTracking pumps = context_.devices.pumps.tracking();
    if (duty_ > 0.0 && toSeconds(now - pressed_) > context_.config.spray.macro_check_after_s &&
        (pumps.no_current || !pumps.blocked.empty())) {
      return {SkillPhase::Failed, status.progress,
              pumps.no_current ? "a pump draws no current: dry, blocked or broken"
                               : fmt::format("pumps: {}", pumps.blocked),
              "pump"};
    }
    if (auto failed = moveOn(now)) return *failed;
    setPumps(duty_, now);
    return status;
  }
  void abort(Stamp now) override {
    timer_.stop(now);
    setPumps(0.0, now);
    if (!round_.empty()) context_.devices.arm.cancel();
  }

 private:
  void beginPress(Stamp now) {
    pressed_ = now;
    round_.clear();
    if (pattern_ == "hourglass") prepareRound(now);
  }
  void setPumps(double duty, Stamp now) {
    PumpSetpoint setpoint;
    setpoint.stamp = now;
    setpoint.duty = {duty, duty};
    context_.devices.pumps.setpoint(setpoint);
  }
  /// The nozzle tilts about where it is now: the round is laid around the arm's present pose.
  void prepareRound(Stamp now) {
    const auto X_base_flange = context_.X_base_flange();
    if (!X_base_flange) return;
    SprayPatternConfig pattern = context_.config.spray.pattern;
    pattern.half_width_deg = tilt_deg_;
    const Eigen::Isometry3d X_flange_nozzle = context_.devices.robot.X_flange_nozzle.pose();
    for (const auto& X_base_nozzle : hourglass(*X_base_flange * X_flange_nozzle, pattern))
      round_.push_back(context_.flangeFor(X_base_nozzle));
    context_.devices.arm.startCartesian(round_, true, now);
  }
  std::optional<SkillStatus> moveOn(Stamp now) {
    if (round_.empty()) return std::nullopt;
    const SkillStatus arm = context_.devices.arm.poll(now);
    if (arm.phase == SkillPhase::Done) context_.devices.arm.startCartesian(round_, true, now);
    if (arm.phase != SkillPhase::Failed) return std::nullopt;
    return arm;
  }

  const FireContext& context_;
  double duty_ = 1.0, seconds_ = 1.0;
  std::string pattern_ = "steady";
  double tilt_deg_ = 2.0;  ///< hourglass: to either side
  StepTimer timer_;
  Stamp pressed_;                         ///< the pumps were switched on
  std::vector<Eigen::Isometry3d> round_;  ///< flange poses in base; empty: the nozzle stays
};

}  // namespace

MacroStepKinds fireMacroSteps(const FireContext& context, const MacroConfig& config) {
  const auto nozzle =
      toolMacroStep({context.devices.robot, context.devices.robot.X_flange_nozzle.pose(),
                     context.devices.arm, config});
  return {{"nozzle", nozzle},
          {"aim", [&context, config] { return std::make_unique<AimStep>(context, config); }},
          {"spray", [&context] { return std::make_unique<SprayStep>(context); }}};
}

}  // namespace kiln
