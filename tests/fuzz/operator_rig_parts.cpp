#include "tests/fuzz/operator_rig_parts.h"

#include "tests/unit/robot/planning/arm_motion/bob.h"

namespace kiln {
namespace {

const ArenaMap& kitchen() {
  static const ArenaMap arena = loadKitchen();
  return arena;
}

/// A step that turns the wrist, then one that sprays.
class MovingStep final : public MacroStep {
 public:
  MovingStep(ArmController& arm, PumpController& pumps, bool sprays)
      : arm_(arm), pumps_(pumps), sprays_(sprays) {}
  void visit(ConfigArchive&) override {}
  [[nodiscard]] std::string text() const override { return sprays_ ? "spray" : "turn"; }
  void addTo(MacroEstimate&) const override {}
  void start(Stamp now) override { timer_.start(now); }
  void resume(Stamp now) override { timer_.resume(now); }
  [[nodiscard]] SkillStatus poll(Stamp now) override {
    const double left_s = (sprays_ ? 0.6 : 0.2) - timer_.elapsedS(now);
    if (left_s <= 0.0) abort(now);
    if (left_s <= 0.0) return {SkillPhase::Done, 1.0, "", ""};
    write(true, now);
    return {SkillPhase::Running, 0.5, "", ""};
  }
  void abort(Stamp now) override {
    timer_.stop(now);
    write(false, now);
  }

 private:
  void write(bool on, Stamp now) {
    if (sprays_) {
      PumpSetpoint spray;
      spray.stamp = now;
      spray.duty.fill(on ? 1.0 : 0.0);
      return pumps_.setpoint(spray);
    }
    ArmSetpoint turn;
    turn.kind = on ? ArmSetpoint::Kind::JointVelocity : ArmSetpoint::Kind::Hold;
    turn.stamp = now;
    turn.qd[5] = 0.2;
    arm_.setpoint(turn);
  }
  ArmController& arm_;
  PumpController& pumps_;
  bool sprays_;
  StepTimer timer_;
};

std::vector<Macro> macros(ArmController& arm, PumpController& pumps) {
  std::vector<Macro> out(1);
  out[0].name = "spray";
  for (const bool sprays : {false, true})
    out[0].steps.push_back(std::make_unique<MovingStep>(arm, pumps, sprays));
  return out;
}

}  // namespace

const RobotGeometry& bob() {
  static const RobotGeometry robot = loadBob();
  return robot;
}

OperatorRig::Parts::Parts(const Clock& clock, Arm& arm_device, DriveBase& base_device,
                          Pumps& pumps_device, Drill& drill, std::string& saved,
                          std::function<GateSituation(Stamp)> situation)
    : machine(MachineCore::Options{.mission = "drill", .mission_uuid = "u"}, clock, drill),
      mission(machine, drill),
      base({}, bob(), base_device, stop),
      arm({}, bob(), arm_device, stop),
      pumps({}, pumps_device, stop),
      teleop({}, bob(), kitchen(), base, arm, pumps),
      runner({[] { return Pose2{}; }, [](const std::string&) { return std::optional<Pose2>(); },
              [this] { return authority.epoch().value(); }},
             macros(arm, pumps)),
      authority(Authority::Config{}),
      host(mission, belief, stop, clock,
           {.write = [&saved](std::string text, bool) { saved = std::move(text); }}),
      control({host,
               authority,
               teleop,
               runner,
               alarms,
               stop,
               arm_device,
               arm,
               &people,
               [] { return Pose2{}; },
               std::move(situation),
               [](const Pose2&) {},
               {}}) {
  drill.base = &base;
  drill.arm = &arm;
  drill.pumps = &pumps;
}

}  // namespace kiln
