#include "robot/missions/fire/states/spray_pattern.h"

#include <fmt/format.h>

#include "robot/missions/fire/skills/spray_pattern.h"
#include "robot/missions/fire/states/aim_hose.h"
#include "robot/missions/fire/states/arm_blocked.h"
#include "robot/missions/fire/states/pump_fault.h"
#include "robot/missions/fire/states/spray_steady.h"
#include "robot/missions/fire/states/spraying.h"
#include "robot/missions/fire/states/stop_pump.h"

namespace kiln {

double SprayPattern::timeLimit(const FireContext& context) {
  return sprayTimeLimit(context, context.config.spray.litres_per_fire - steadyLitres(context));
}

std::string SprayPattern::denyEntry(const FireContext& context) {
  return SpraySteady::denyEntry(context);
}

void SprayPattern::enter() {
  // One moment without duty ends the uninterrupted run that the pump control limits.
  context().pumpsOff(now());
  steady_ = !context().aim.has_value();
  if (!steady_) beginRound();
}

void SprayPattern::beginRound() {
  FireContext& c = context();
  std::vector<Eigen::Isometry3d> path;
  for (const Eigen::Isometry3d& X_base_nozzle :
       hourglass(c.aim->X_base_nozzle(), c.config.spray.pattern))
    path.push_back(c.flangeFor(X_base_nozzle));
  c.devices.arm.startCartesian(std::move(path), true, now());
  ++rounds_;
}

Transition SprayPattern::execute() {
  FireContext& c = context();
  if (const auto fault = keepSpraying(c, now(), timeInState()))
    return transit<PumpFault>().because(*fault);
  if (!guard("Arm at spray pose", c.atSprayPose()))
    return transit<AimHose>().because("the nozzle is not where it was aimed");
  const double litres = c.place().litres_est;
  const double goal = c.config.spray.litres_per_fire;
  display(fmt::format("{:.2f} of {:.2f} l (est.), {}", litres, goal,
                      steady_ ? std::string("steady") : fmt::format("round {}", rounds_)));
  if (guard("Phase 2 complete", litres >= goal, fmt::format("{:.2f} l (est.)", litres)))
    return transit<StopPump>().because(fmt::format("{:.2f} l (est.)", litres));
  if (steady_) return stay();
  const SkillStatus arm = c.devices.arm.poll(now());
  if (arm.phase == SkillPhase::Done) beginRound();
  if (arm.phase == SkillPhase::Failed) {
    if (arm.failure_code != "unreachable" && arm.failure_code != "in_collision")
      return transit<ArmBlocked>(arm.text, ArmBlocked::While::Extended).because(arm.text);
    steady_ = true;
  }
  return stay();
}

}  // namespace kiln
