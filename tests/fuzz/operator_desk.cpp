#include "tests/fuzz/operator_desk.h"

#include <array>
#include <cmath>

#include "tests/unit/robot/planning/arm_motion/bob.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;

constexpr Duration kControl = milliseconds(10);
constexpr int kControlTicks = 2;  // a mission tick
// How long after the last permission each actuator may still move: time-out of the setpoint, then
// its slowest ramp.
constexpr double kBaseRest_s = 1.2, kArmRest_s = 1.0, kPumpsOff_s = 0.3;
constexpr double kStill_mps = 0.01, kStill_radps = 0.01;

constexpr std::array<const char*, static_cast<std::size_t>(Act::Count)> kNames{
    "Tick",         "LinkGap",         "LongSilence",  "Stop",
    "OtherStop",    "MotionWatchStop", "ClearStop",    "ClearOldStop",
    "AcquireLease", "ReleaseLease",    "TakeOver",     "JogBase",
    "JogArm",       "HoldPump",        "HoldMacro",    "Again",
    "OldPress",     "Release",         "Teleop",       "Autonomous",
    "Start",        "Pause",           "Resume",       "ForceWork",
    "ForceDone",    "Finish",          "PositionLost", "PositionFound",
    "NotReady",     "Ready",           "ArmSilent",    "BaseSilent",
    "PumpsSilent",  "ProtectiveStop",  "DevicesBack",  "Reset",
    "KillAndResume"};

const RobotGeometry& bob() {
  static const RobotGeometry robot = loadBob();
  return robot;
}
const ArenaMap& kitchen() {
  static const ArenaMap arena = loadKitchen();
  return arena;
}

/// Macros of this desk do not move the arm.
class RestingArm final : public ArmMotion {
 public:
  void startJoints(const Vector6d&, Stamp) override {}
  void startPose(const Eigen::Isometry3d&, Stamp) override {}
  void startCartesian(std::vector<Eigen::Isometry3d>, bool, Stamp) override {}
  void startBack(double, Stamp) override {}
  SkillStatus poll(Stamp) override { return {SkillPhase::Done, 1.0, "", ""}; }
  void cancel() override {}
  [[nodiscard]] Result<Vector6d> check(const Eigen::Isometry3d&) const override {
    return Vector6d::Zero().eval();
  }
};

/// Waits, then sprays.
std::vector<Macro> macros() {
  Macro macro;
  macro.name = "spray";
  macro.steps.resize(2);
  macro.steps[0].seconds = 0.1;
  macro.steps[1].action = "spray";
  macro.steps[1].seconds = 0.6;
  return {macro};
}

JogArm armJog() {
  JogArm jog;
  jog.frame = JogFrame::Joint;
  jog.velocity[5] = 0.3;
  return jog;
}

CommandBody zeroOf(const CommandBody& body) {
  if (std::holds_alternative<JogBase>(body)) return JogBase{};
  if (std::holds_alternative<JogArm>(body)) return JogArm{};
  if (std::holds_alternative<HoldPump>(body)) return HoldPump{};
  return HoldMacro{};
}

}  // namespace

const char* nameOf(Act act) { return kNames[static_cast<std::size_t>(act)]; }

Transition DrillWork::execute() {
  drive(0.3);
  if (context().finished) return transit<DrillDone>();
  return timeInState() > milliseconds(500) ? transit<DrillRest>() : stay();
}
Transition DrillRest::execute() {
  drive(-0.3);
  return timeInState() > milliseconds(200) ? transit<DrillWork>() : stay();
}

/// Carries the robot back when asked for a reset.
class OperatorDesk::People final : public Arena {
 public:
  Result<void> requestReset() override {
    asked = true;
    return {};
  }
  bool asked = false;
};

struct OperatorDesk::Parts {
  explicit Parts(OperatorDesk& desk)
      : machine(MachineCore::Options{.mission = "drill", .mission_uuid = "u"}, desk.clock_,
                desk.drill_),
        mission(machine),
        base({}, bob(), desk.base_, stop),
        arm({}, bob(), desk.arm_, stop),
        pumps({}, desk.pumps_, stop),
        teleop({}, bob(), kitchen(), base, arm, pumps),
        runner({},
               {bob(), kitchen(), resting_arm, pumps, SprayCalibration{}, [] { return Pose2{}; },
                [] { return std::optional(Eigen::Isometry3d::Identity()); },
                [this] { return authority.epoch().value(); }},
               macros()),
        authority(Authority::Config{}),
        host(mission, belief, stop, desk.clock_),
        control({host,
                 authority,
                 teleop,
                 runner,
                 alarms,
                 stop,
                 desk.arm_,
                 arm,
                 people,
                 [] { return Pose2{}; },
                 [&desk](Stamp) { return desk.devicesAndChecks(); },
                 [](const Pose2&) {},
                 {}}) {
    desk.drill_.base = &base;
  }
  StopLatch stop;
  DrillMachine machine;
  MachineMission mission;
  RobotBelief belief;
  BaseController base;
  ArmController arm;
  PumpController pumps;
  RestingArm resting_arm;
  Teleop teleop;
  MacroRunner runner;
  AlarmBook alarms;
  Authority authority;
  MissionHost host;
  People people;
  MissionControl control;
};

OperatorDesk::OperatorDesk(bool start_by_itself)
    : arm_(clock_, bob(), RobotGeometry::radians(bob().q_drive_deg)),
      base_(clock_, bob()),
      pumps_(clock_) {
  build();
  if (start_by_itself) parts_->host.waitForStart();
}
OperatorDesk::~OperatorDesk() = default;

void OperatorDesk::build() { parts_ = std::make_unique<Parts>(*this); }

std::string OperatorDesk::perform(Act act) {
  batch_.clear();
  acknowledged_ = other_stop_ = false;
  int quiet_ticks = 0;
  if (act == Act::LinkGap) quiet_ticks = 20;
  if (act == Act::LongSilence) quiet_ticks = 115;
  for (int i = 0; i < quiet_ticks; ++i) {
    tick(act == Act::LinkGap);
    if (std::string what = broken(); !what.empty()) return what;
  }
  if (quiet_ticks > 0) ended_press_ = press_;
  give(act);
  tick(true);
  return broken();
}

GateSituation OperatorDesk::devicesAndChecks() const {
  GateSituation found;
  found.ready = ready_ && located_;  // one of the checks
  found.position_lost = located_ ? "" : "position lost";
  found.view_age_s = 0.1;
  const auto arm = arm_.state();
  found.protective_stop = arm && arm->safety == ArmSafetyMode::ProtectiveStop;
  found.base_moving = std::abs(parts_->base.tracking().measured.vx_mps) > kStill_mps;
  return found;
}

GateSituation OperatorDesk::situation(Stamp at) const { return parts_->control.situation(at); }

std::optional<CommandAck> OperatorDesk::execute(const Authority::Accepted& accepted, Stamp at) {
  const CommandBody& body = accepted.command.body;
  if (std::holds_alternative<ClearStop>(body) && std::exchange(other_stop_, false)) stopBy("Ben");
  if (isSetpoint(body) && !isRelease(body)) {
    hand_moved_ = true;
    hand_moved_base_ = hand_moved_base_ || std::holds_alternative<JogBase>(body);
    hand_press_ = accepted.command.press;
  }
  auto ack = parts_->control.execute(accepted, at);
  const bool starts = std::holds_alternative<StartMission>(body) ||
                      std::holds_alternative<kiln::Resume>(body) ||
                      std::holds_alternative<ChangeState>(body);
  if (starts && ack && ack->outcome == AckOutcome::Done) deliberate_ = true;
  return ack;
}
void OperatorDesk::onReleased(const std::vector<HoldKind>& kinds, Stamp at) {
  parts_->control.onReleased(kinds, at);
}
void OperatorDesk::onLeaseLost(Stamp at) { parts_->control.onLeaseLost(at); }

void OperatorDesk::send(CommandBody body, std::uint64_t press, const char* client) {
  ReceivedCommand received;
  received.command.client_id = received.command.operator_name = client;
  received.command.nonce = ++nonce_;
  received.command.lease_epoch = parts_->authority.lease(now()).epoch;
  received.command.press = press;
  received.command.body = std::move(body);
  batch_.push_back(std::move(received));
}

void OperatorDesk::press(CommandBody body) {
  pressed_ = body;
  send(std::move(body), ++press_);
}

void OperatorDesk::stopBy(const char* who) {
  acknowledged_ = true;
  (void)parts_->stop.set(who, now());
  asleep_ = true;
  asleep_since_ = now();
  ended_press_ = press_;
}

void OperatorDesk::force(const char* to) {
  const FsmStatus seen = parts_->machine.status(now());
  send(ChangeState{seen.state, seen.step, to});
}

void OperatorDesk::give(Act act) {
  const std::uint64_t generation = parts_->stop.generation();
  switch (act) {
    case Act::Tick:
    case Act::LinkGap:
    case Act::LongSilence:
    case Act::Count:
      return;
    case Act::Stop:
      return stopBy("Ann");
    case Act::MotionWatchStop:
      return stopBy("motion watch");
    case Act::OtherStop:
      other_stop_ = true;
      return send(ClearStop{generation});
    case Act::ClearStop:
      return send(ClearStop{generation});
    case Act::ClearOldStop:
      return send(ClearStop{generation == 0 ? 0 : generation - 1});
    case Act::AcquireLease:
      return send(AcquireLease{});
    case Act::ReleaseLease:
      send(ReleaseLease{});
      ended_press_ = press_;
      return;
    case Act::TakeOver:
      return send(AcquireLease{true}, 0, "ben");
    case Act::JogBase:
      return press(JogBase{{0.3, 0, 0}});
    case Act::JogArm:
      return press(armJog());
    case Act::HoldPump:
      return press(HoldPump{1.0, 1.0});
    case Act::HoldMacro:
      return press(HoldMacro{"spray", false});
    case Act::Again:
      return press_ > 0 ? send(pressed_, press_) : void();
    case Act::OldPress:
      return press_ > 1 ? send(pressed_, press_ - 1) : void();
    case Act::Release:
      if (press_ > 0) send(zeroOf(pressed_), press_);
      send(ReleaseAll{});
      ended_press_ = press_;
      return;
    case Act::Teleop:
      return send(SetMode{Mode::Teleop});
    case Act::Autonomous:
      return send(SetMode{Mode::Autonomous});
    case Act::Start:
      return send(StartMission{});
    case Act::Pause:
      return send(kiln::Pause{});
    case Act::Resume:
      return send(kiln::Resume{});
    case Act::ForceWork:
      return force("DrillWork");
    case Act::ForceDone:
      return force("DrillDone");
    case Act::Finish:
      drill_.finished = !drill_.finished;
      return;
    case Act::PositionLost:
      located_ = false;
      return;
    case Act::PositionFound:
      located_ = true;
      return;
    case Act::NotReady:
      ready_ = false;
      return;
    case Act::Ready:
      ready_ = true;
      return;
    case Act::ArmSilent:
      return arm_.freezeState(true);
    case Act::BaseSilent:
      return base_.freezeState(true);
    case Act::PumpsSilent:
      return pumps_.freezeState(true);
    case Act::ProtectiveStop:
      return arm_.setSafety(ArmSafetyMode::ProtectiveStop);
    case Act::DevicesBack:
      arm_.freezeState(false);
      base_.freezeState(false);
      pumps_.freezeState(false);
      return send(ReleaseProtectiveStop{});
    case Act::Reset:
      return send(ResetRobot{});
    case Act::KillAndResume:
      return killAndResume();
  }
}

/// The daemon is killed and goes on from its checkpoint; operators start anew.
void OperatorDesk::killAndResume() {
  if (!parts_->machine.begun()) return;
  const MissionCheckpoint checkpoint = parts_->host.checkpoint();
  const int visits = drill_.visits;
  const bool stood = !parts_->machine.running() || !checkpoint.holds.empty();
  const Stamp clock_start = parts_->belief.clock_start;
  build();
  lost_in_restart_ = !parts_->host.restore(checkpoint, now()).has_value() ||
                     parts_->machine.info().mission_uuid != checkpoint.fsm.mission_uuid ||
                     parts_->belief.clock_start != clock_start;
  visits_expected_ = drill_.visits = visits;
  if (stood && !asleep_) asleep_since_ = now();
  asleep_ = asleep_ || stood;
  press_ = ended_press_ = 0;
}

void OperatorDesk::tick(bool heard) {
  setpoints_before_ = drill_.setpoints;
  hand_moved_ = hand_moved_base_ = deliberate_ = false;
  for (int i = 0; i < kControlTicks; ++i) {
    clock_.advanceBy(kControl);
    arm_.advance();
    base_.advance();
    pumps_.advance();
    parts_->base.tick(now());
    parts_->arm.tick(now());
    parts_->pumps.tick(now());
  }
  Parts& p = *parts_;
  if (std::exchange(p.people.asked, false)) {
    p.base.resetOdometry();
    p.control.onReset(now());
  }
  if (!located_ && p.host.phase() == MissionPhase::Running)
    p.control.holdMission(HoldReason::PositionLost, "position lost", now());
  p.control.observeStop(now());
  std::vector<OperatorPeer> peers(heard ? 2 : 0);
  for (std::size_t i = 0; i < peers.size(); ++i) {
    peers[i].client_id = i == 0 ? "ann" : "ben";
    peers[i].last_heard = now();
  }
  for (ReceivedCommand& received : batch_) received.received = received.command.issued = now();
  (void)p.authority.step(std::exchange(batch_, {}), peers, *this, now());
  p.host.goOnWhenAllowed(p.control.situation(now()), now());
  p.control.step(now());
}

/// Everything that moves does so because somebody asks for it now, or did a moment ago.
std::string OperatorDesk::movesUnasked() {
  Parts& p = *parts_;
  const bool runs = p.host.phase() == MissionPhase::Running && !p.stop.latched();
  if (runs || p.authority.held(HoldKind::BaseJog, now())) base_asked_ = now();
  if (p.authority.held(HoldKind::ArmJog, now())) arm_asked_ = now();
  if (p.authority.held(HoldKind::Pump, now()) || p.runner.running()) pumps_asked_ = now();
  const auto since = [&](Stamp asked) { return toSeconds(now() - asked); };
  if (std::abs(p.base.tracking().commanded.vx_mps) > kStill_mps && since(base_asked_) > kBaseRest_s)
    return "5: the base moves and nobody asks for it";
  if (arm_.state()->qd.cwiseAbs().maxCoeff() > kStill_radps && since(arm_asked_) > kArmRest_s)
    return "5: the arm moves and nobody asks for it";
  const auto duty = p.pumps.tracking().duty;
  if (duty[0] + duty[1] > 0.0 && since(pumps_asked_) > kPumpsOff_s)
    return "6: water runs and nobody asks for it";
  return {};
}

std::string OperatorDesk::broken() {
  Parts& p = *parts_;
  p.host.check();
  const bool machine_moved = drill_.setpoints != setpoints_before_;
  const MissionPhase phase = p.host.phase();
  if (machine_moved && (p.stop.latched() || p.host.mode() == Mode::Teleop ||
                        phase == MissionPhase::Held || phase == MissionPhase::Waiting))
    return "1: the machine writes a setpoint while it may not";
  if (hand_moved_base_ && machine_moved) return "2: two writers of the base";
  if (asleep_ && (deliberate_ || (hand_moved_ && hand_press_ > ended_press_))) asleep_ = false;
  if (asleep_ && machine_moved) return "3: moves without a deliberate act since the STOP";
  if (asleep_ && toSeconds(now() - asleep_since_) > kBaseRest_s &&
      std::abs(p.base.tracking().commanded.vx_mps) > kStill_mps)
    return "3: the base moves without a deliberate act since the STOP";
  if (acknowledged_ && !p.stop.latched()) return "4: an acknowledged STOP is gone";
  if (hand_moved_ && hand_press_ <= ended_press_) return "5: a press that was over moves something";
  if (lost_in_restart_) return "7: id or clock of the mission were lost";
  if (visits_expected_ >= 0 && drill_.visits < visits_expected_) return "7: counters were lost";
  return movesUnasked();
}

}  // namespace kiln
