#include "robot/skills/macro_step.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kiln {
namespace {

constexpr double kDeg = M_PI / 180.0;

Eigen::Isometry3d flangeFor(const RobotGeometry& robot, const Eigen::Isometry3d& X_base_nozzle) {
  return X_base_nozzle * robot.X_flange_nozzle.pose().inverse();
}

/// A motion of the arm: the subclass says where to.
class ArmStep : public MacroStepRun {
 public:
  explicit ArmStep(MacroRunner::Parts& parts) : parts_(parts) {}
  void start(Stamp now) override {
    if (auto started = begin(now); !started) failure_ = started.error().message;
  }
  SkillStatus poll(Stamp now) override {
    if (!failure_.empty()) return {SkillPhase::Failed, 0.0, failure_, "unreachable"};
    return parts_.arm.poll(now);
  }
  void abort(Stamp) override { parts_.arm.cancel(); }

 protected:
  virtual Result<void> begin(Stamp now) = 0;
  MacroRunner::Parts& parts_;

 private:
  std::string failure_;
};

class JointsStep final : public ArmStep {
 public:
  JointsStep(const MacroStep& step, MacroRunner::Parts& parts) : ArmStep(parts), step_(step) {}

 private:
  Result<void> begin(Stamp now) override {
    const auto& q_deg = step_.pose == "park"    ? parts_.robot.q_park_deg
                        : step_.pose == "drive" ? parts_.robot.q_drive_deg
                                                : step_.q_deg;
    parts_.arm.startJoints(RobotGeometry::radians(q_deg), now);
    return {};
  }
  MacroStep step_;
};

class NozzleStep final : public ArmStep {
 public:
  NozzleStep(const MacroStep& step, MacroRunner::Parts& parts) : ArmStep(parts), step_(step) {}

 private:
  Result<void> begin(Stamp now) override {
    const Eigen::Vector3d p(step_.xyz_m[0], step_.xyz_m[1], step_.xyz_m[2]);
    // Positive pitch looks up, which is a negative turn about Y.
    const auto X_base_nozzle = makePose(p, {0.0, -step_.pitch_deg * kDeg, step_.yaw_deg * kDeg});
    parts_.arm.startPose(flangeFor(parts_.robot, X_base_nozzle), now);
    return {};
  }
  MacroStep step_;
};

/// Aims by the arena's configured plate and the robot's present pose: no heat estimate is needed,
/// which is what makes it a fallback.
class AimStep final : public ArmStep {
 public:
  AimStep(const MacroStep& step, const MacroRunnerConfig& config, MacroRunner::Parts& parts)
      : ArmStep(parts), step_(step), config_(config) {}

 private:
  Result<void> begin(Stamp now) override {
    const auto& places = parts_.arena.fire_places;
    const auto place = std::find_if(places.begin(), places.end(),
                                    [&](const auto& p) { return p.name == step_.place; });
    if (place == places.end()) {
      return makeError(ErrorCode::NotFound, "the arena has no fire place '{}'", step_.place);
    }
    AimTarget target;
    target.p_plate_map =
        Eigen::Vector3d(place->plate_xyz_m[0], place->plate_xyz_m[1], place->plate_xyz_m[2]);
    const double yaw = place->facing_deg * kDeg;
    target.normal_map = Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0.0);
    target.recess_m = parts_.arena.recess_m;
    AimSolverConfig solver = config_.aim;
    solver.standoff_m = std::clamp(step_.standoff_m, solver.min_standoff_m, solver.max_standoff_m);
    const Eigen::Isometry3d X_base_map = toIsometry(parts_.pose()).inverse();
    const auto flange = [&](const Eigen::Isometry3d& X_map_nozzle) {
      return flangeFor(parts_.robot, X_base_map * X_map_nozzle);
    };
    const auto solution = solveAim(target, solver, parts_.calibration, flowScale(),
                                   [&](const Eigen::Isometry3d& X_map_nozzle) -> Result<void> {
                                     auto q = parts_.arm.check(flange(X_map_nozzle));
                                     if (!q) return tl::make_unexpected(q.error());
                                     return {};
                                   });
    if (!solution) return tl::make_unexpected(solution.error());
    parts_.arm.startPose(flange(solution->X_map_nozzle), now);
    return {};
  }
  [[nodiscard]] double flowScale() const {
    const auto& tanks = parts_.pumps.tracking().tank_l_est;
    const double litres = std::accumulate(tanks.begin(), tanks.end(), 0.0);
    return parts_.calibration.flowScale(litres / (2.0 * config_.tank_l));
  }
  MacroStep step_;
  MacroRunnerConfig config_;
};

class SprayStep final : public MacroStepRun {
 public:
  SprayStep(const MacroStep& step, const MacroRunnerConfig& config, MacroRunner::Parts& parts)
      : step_(step), config_(config), parts_(parts) {}

  void start(Stamp now) override {
    began_ = now;
    if (step_.pattern == "hourglass") prepareRound(now);
  }
  SkillStatus poll(Stamp now) override {
    const double elapsed_s = toSeconds(now - began_);
    SkillStatus status{SkillPhase::Running, std::min(1.0, elapsed_s / step_.seconds),
                       fmt::format("{:.0f} s to go", std::max(0.0, step_.seconds - elapsed_s)), ""};
    if (elapsed_s >= step_.seconds) {
      abort(now);
      status.phase = SkillPhase::Done;
      return status;
    }
    const PumpTracking pumps = parts_.pumps.tracking();
    if (step_.duty > 0.0 && elapsed_s > config_.pump_check_after_s &&
        (pumps.no_current || !pumps.blocked.empty())) {
      return {SkillPhase::Failed, status.progress,
              pumps.no_current ? "a pump draws no current: dry, blocked or broken"
                               : fmt::format("pumps: {}", pumps.blocked),
              "pump"};
    }
    if (auto failed = moveOn(now)) return *failed;
    setPumps(step_.duty, now);
    return status;
  }
  void abort(Stamp now) override {
    setPumps(0.0, now);
    if (moving_) parts_.arm.cancel();
  }

 private:
  void setPumps(double duty, Stamp now) {
    PumpSetpoint setpoint;
    setpoint.stamp = now;
    setpoint.duty = {duty, duty};
    parts_.pumps.setpoint(setpoint);
  }
  /// The nozzle tilts about where it is now: the round is laid around the arm's present pose.
  void prepareRound(Stamp now) {
    const auto X_base_flange = parts_.flange();
    if (!X_base_flange) return;
    SprayPatternConfig pattern = config_.pattern;
    pattern.half_width_deg = step_.tilt_deg;
    for (const auto& X_base_nozzle :
         hourglass(*X_base_flange * parts_.robot.X_flange_nozzle.pose(), pattern)) {
      round_.push_back(flangeFor(parts_.robot, X_base_nozzle));
    }
    parts_.arm.startCartesian(round_, true, now);
    moving_ = true;
  }
  std::optional<SkillStatus> moveOn(Stamp now) {
    if (!moving_) return std::nullopt;
    const SkillStatus arm = parts_.arm.poll(now);
    if (arm.phase == SkillPhase::Done) parts_.arm.startCartesian(round_, true, now);
    if (arm.phase != SkillPhase::Failed) return std::nullopt;
    return arm;
  }

  MacroStep step_;
  MacroRunnerConfig config_;
  MacroRunner::Parts& parts_;
  Stamp began_;
  std::vector<Eigen::Isometry3d> round_;  ///< flange poses in base
  bool moving_ = false;
};

class WaitStep final : public MacroStepRun {
 public:
  explicit WaitStep(double seconds) : seconds_(seconds) {}
  void start(Stamp now) override { began_ = now; }
  SkillStatus poll(Stamp now) override {
    const double elapsed_s = toSeconds(now - began_);
    return {elapsed_s >= seconds_ ? SkillPhase::Done : SkillPhase::Running,
            std::min(1.0, elapsed_s / seconds_), "", ""};
  }
  void abort(Stamp) override {}

 private:
  double seconds_;
  Stamp began_;
};

}  // namespace

std::unique_ptr<MacroStepRun> makeMacroStep(const MacroStep& step, const MacroRunnerConfig& config,
                                            MacroRunner::Parts& parts) {
  if (step.action == "arm") return std::make_unique<JointsStep>(step, parts);
  if (step.action == "nozzle") return std::make_unique<NozzleStep>(step, parts);
  if (step.action == "aim") return std::make_unique<AimStep>(step, config, parts);
  if (step.action == "spray") return std::make_unique<SprayStep>(step, config, parts);
  return std::make_unique<WaitStep>(step.seconds);
}

std::string stepText(const MacroStep& step) {
  if (step.action == "arm") {
    return step.pose.empty() ? "arm to its joints" : fmt::format("arm to {}", step.pose);
  }
  if (step.action == "nozzle") {
    return fmt::format("nozzle to {:.2f}, {:.2f}, {:.2f} m", step.xyz_m[0], step.xyz_m[1],
                       step.xyz_m[2]);
  }
  if (step.action == "aim") return fmt::format("aim at {}", step.place);
  if (step.action == "spray") return fmt::format("spray {:.0f} s {}", step.seconds, step.pattern);
  return fmt::format("wait {:.0f} s", step.seconds);
}

}  // namespace kiln
