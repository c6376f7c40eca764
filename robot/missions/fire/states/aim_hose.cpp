#include "robot/missions/fire/states/aim_hose.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "common/core/units.h"
#include "robot/missions/fire/skills/pose_step.h"
#include "robot/missions/fire/states/arm_blocked.h"
#include "robot/missions/fire/states/lost_target.h"
#include "robot/missions/fire/states/start_pump.h"

namespace kiln {
namespace {

/// Largest standard deviation in any direction.
double largestSigma(const FireEstimate& estimate) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(estimate.covariance,
                                                              Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

}  // namespace

void AimHose::enter() {
  FireContext& c = context();
  moving_ = false;
  c.pumpsOff(now());
  c.aim.reset();
  c.heat.listen(c.placeNormal());
  stopped_ = now();
  sightings_at_stop_ = c.heat.sightings();
}

void AimHose::leave() {
  context().heat.stopListening();
  context().haltMotion();
}

Transition AimHose::execute() {
  FireContext& c = context();
  const std::optional<FireEstimate> estimate = c.estimate();
  if (!estimate) return transit<LostTarget>().because("there is no estimate of the heat source");
  c.place().estimate = estimate;
  publishGuards(*estimate);
  if (targetLost()) return transit<LostTarget>().because("the heat source is out of sight");
  if (moving_) {
    const SkillStatus arm = c.devices.arm.poll(now());
    display(fmt::format("step {}: {}", steps_, arm.text));
    if (arm.phase == SkillPhase::Failed) return onStepFailed(arm);
    if (arm.phase != SkillPhase::Done) return stay();
    moving_ = false;
    stopped_ = now();
    sightings_at_stop_ = c.heat.sightings();
  }
  const auto X_map_nozzle = c.X_map_nozzle();
  if (!settled() || !X_map_nozzle) return stay();
  if (auto aimed = updateAim(*estimate); !aimed)
    return transit<ArmBlocked>(aimed.error().message, ArmBlocked::While::Extended)
        .because(aimed.error().message);
  if (!atPose(*X_map_nozzle, c.aim->solution.X_map_nozzle, c.config.aim.position_tolerance_m,
              c.config.aim.angle_tolerance_deg * kDeg)) {
    beginStep(*X_map_nozzle);
    return stay();
  }
  if (largestSigma(*estimate) > c.config.aim.max_sigma_m) return stay();  // measure on
  return transit<StartPump>().because(fmt::format("aimed in {} steps", steps_));
}

bool AimHose::targetLost() const {
  const FireContext& c = context();
  const double limit_s = c.config.aim.lost_after_s;
  const double image_age_s = c.heat.imageAgeS(now());
  const bool blind = image_age_s < 0.0 || image_age_s > limit_s;
  return c.heat.unseenForS() > limit_s || (blind && toSeconds(timeInState()) > limit_s);
}

void AimHose::publishGuards(const FireEstimate& estimate) {
  const FireContext& c = context();
  const double seen_age_s = c.heat.seenAgeS(now());
  guard("Heat source seen recently", seen_age_s >= 0.0 && seen_age_s <= c.config.aim.lost_after_s,
        fmt::format("{} sightings", c.heat.sightings()), seen_age_s);
  const double sigma_m = largestSigma(estimate);
  guard(fmt::format("Estimate within {:.0f} cm", 100.0 * c.config.aim.max_sigma_m),
        sigma_m <= c.config.aim.max_sigma_m, fmt::format("{:.1f} cm", 100.0 * sigma_m),
        toSeconds(now() - estimate.stamp));
  const auto X_map_nozzle = c.X_map_nozzle();
  const double to_go_m =
      c.aim && X_map_nozzle
          ? (c.aim->solution.X_map_nozzle.translation() - X_map_nozzle->translation()).norm()
          : -1.0;
  guard("Arm at spray pose", c.atSprayPose(),
        to_go_m < 0.0 ? std::string("not chosen yet")
                      : fmt::format("{:.0f} cm to go", 100.0 * to_go_m));
  const PumpTracking pumps = c.devices.pumps.tracking();
  guard("Pump ready", !pumps.heartbeat_lost,
        fmt::format("{:.1f} l + {:.1f} l (est.)", pumps.tank_l_est[0], pumps.tank_l_est[1]),
        toSeconds(now() - pumps.stamp));
}

bool AimHose::settled() const {
  const FireAimConfig& config = context().config.aim;
  return context().heat.sightings() - sightings_at_stop_ >= config.settle_views ||
         toSeconds(now() - stopped_) >= config.settle_s;
}

Result<void> AimHose::updateAim(const FireEstimate& estimate) {
  FireContext& c = context();
  const AimTarget target = c.aimTarget(estimate);
  const auto feasible = [&c](const Eigen::Isometry3d& X_map_nozzle) -> Result<void> {
    auto checked = c.devices.arm.check(c.flangeForNozzle(X_map_nozzle));
    if (!checked) return tl::make_unexpected(checked.error());
    return {};
  };
  if (c.aim) {  // keep the way of standing as long as it works
    const Eigen::Isometry3d X =
        aimNozzle(target, c.aim->solution.variation, c.calibration, c.flowScale());
    if (feasible(X)) {
      c.aim->solution.X_map_nozzle = X;
      c.aim->X_map_base = c.devices.pose();
      return {};
    }
  }
  auto solution = solveAim(target, c.config.aim.solver, c.calibration, c.flowScale(), feasible);
  if (!solution) return tl::make_unexpected(solution.error());
  c.aim = FireContext::Aim{*solution, c.devices.pose()};
  return {};
}

void AimHose::beginStep(const Eigen::Isometry3d& X_map_nozzle) {
  FireContext& c = context();
  const Eigen::Isometry3d X_next = poseStep(X_map_nozzle, c.aim->solution.X_map_nozzle,
                                            c.config.aim.step_m, c.config.aim.max_turn_deg * kDeg);
  X_base_flange_step_ = c.flangeForNozzle(X_next);
  c.devices.arm.startCartesian({X_base_flange_step_}, false, now());
  moving_ = true;
  detour_ = false;
  ++steps_;
}

Transition AimHose::onStepFailed(const SkillStatus& arm) {
  FireContext& c = context();
  const bool geometric = arm.failure_code == "unreachable" || arm.failure_code == "in_collision";
  if (!geometric || detour_)
    return transit<ArmBlocked>(arm.text, ArmBlocked::While::Extended).because(arm.text);
  // No straight line: the whole way to the spray pose by a planned joint motion, which is known to
  // be reachable.
  detour_ = true;
  c.devices.arm.startPose(c.flangeForNozzle(c.aim->solution.X_map_nozzle), now());
  return stay();
}

}  // namespace kiln
