#include "tests/fuzz/operator_rig.h"

#include <algorithm>
#include <cmath>

#include "tests/fuzz/operator_rig_parts.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;

constexpr Duration kControl = milliseconds(10);
constexpr int kControlTicks = 2;  // a mission tick
// How long after the last permission each actuator may still move: time-out of the setpoint, then
// its slowest ramp.
constexpr double kBaseRest_s = 0.9, kArmRest_s = 0.6, kPumpsOff_s = 0.3;
constexpr double kPressOver_s = 0.26;  // the dead-man's 0.25 s, and less than a tick
constexpr double kStill_mps = 0.01, kStill_radps = 0.01;

}  // namespace

OperatorRig::OperatorRig(bool start_by_itself)
    : arm_(clock_, bob(), RobotGeometry::radians(bob().q_drive_deg)),
      base_(clock_, bob()),
      pumps_(clock_),
      q_(arm_.trueQ()) {
  info_.actuators = Teleop::actuators();
  drill_.moves = [this] { judgeMachineWrite(); };
  build();
  if (start_by_itself) parts_->host.waitForStart();
}
OperatorRig::~OperatorRig() = default;

void OperatorRig::build() {
  parts_ = std::make_unique<Parts>(clock_, arm_, base_, pumps_, drill_, saved_,
                                   [this](Stamp) { return devicesAndChecks(); });
}

GateSituation OperatorRig::devicesAndChecks() const {
  GateSituation found;
  found.mission = &info_;
  found.ready = ready_ && located_;  // one of the checks
  found.position_lost = located_ ? "" : "position lost";
  found.view_age_s = sees_ ? 0.1 : 2.0;
  const auto arm = arm_.state();
  found.protective_stop = arm && arm->safety == ArmSafetyMode::ProtectiveStop;
  found.base_moving = std::abs(parts_->base.tracking().measured.vx_mps) > kStill_mps;
  return found;
}

GateSituation OperatorRig::situation(Stamp at) const { return parts_->control.situation(at); }

std::optional<CommandAck> OperatorRig::execute(const Authority::Accepted& accepted, Stamp at) {
  const Command& command = accepted.command;
  if (std::holds_alternative<ClearStop>(command.body) && std::exchange(other_stop_, false))
    stopBy("Ben");
  judgeCommand(command);
  const Mode mode = parts_->host.mode();
  const std::uint64_t step = parts_->machine.checkpoint().step;
  if (letsGo(command.body)) asleep_ = machine_asleep_ = false;
  const bool macro_ran = parts_->runner.running();
  auto ack = parts_->control.execute(accepted, at);
  if (parts_->runner.running() && !macro_ran) {
    arm_writer_ = pumps_writer_ = Writer::Program;
    for (Press& press : presses_)  // what else is held ends
      press.over = press.over || (press.last && holdKind(press.body) != HoldKind::Macro);
  }
  if (!ack || ack->outcome != AckOutcome::Done) return ack;
  const auto* change = std::get_if<ChangeState>(&command.body);
  if (change && change->step != step) breaks("5: a command of an old step has an effect");
  noteDone(command, mode);
  return ack;
}
void OperatorRig::onReleased(const std::vector<HoldKind>& kinds, Stamp at) {
  parts_->control.onReleased(kinds, at);
}
void OperatorRig::onLeaseLost(Stamp at) { parts_->control.onLeaseLost(at); }

void OperatorRig::tick(bool heard) {
  for (int i = 0; i < kControlTicks; ++i) {
    clock_.advanceBy(kControl);
    arm_.advance();
    base_.advance();
    pumps_.advance();
    parts_->tickControllers(now());
  }
  judgeWriters();
  Parts& p = *parts_;
  if (std::exchange(p.people.asked, false)) {
    p.base.resetOdometry();
    p.control.onReset(now());
  }
  if (!located_ && p.host.phase() == MissionPhase::Running) {
    p.control.checkPosition("position lost", now());
    machine_asleep_ = true;
  }
  handleCommands(heard);
  p.host.goOnWhenAllowed(p.control.situation(now()), now());
  p.control.step(now());
  judgeTick();
}

void OperatorRig::handleCommands(bool heard) {
  parts_->control.observeStop(now());
  stop_unseen_ = false;
  std::vector<OperatorPeer> peers(heard ? 2 : 0);
  for (std::size_t i = 0; i < peers.size(); ++i) {
    peers[i].client_id = i == 0 ? "ann" : "ben";
    peers[i].last_heard = now();
  }
  std::vector<ReceivedCommand> received(batch_.size());
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    received[i].command = std::move(batch_[i].command);
    received[i].command.issued = now() - batch_[i].age;
    received[i].received = now();
    received[i].rtt_s = slow_ ? 0.6 : 0.02;
  }
  batch_.clear();
  (void)parts_->authority.step(received, peers, *this, now());
  if (std::exchange(late_stop_, false)) stopBy("Ben");
}

void OperatorRig::breaks(const char* what) {
  if (broken_.empty()) broken_ = what;
}

/// A deliberate act after which the machine may move.
bool OperatorRig::letsGo(const CommandBody& body) const {
  if (std::holds_alternative<StartMission>(body) || std::holds_alternative<Resume>(body))
    return true;
  const MissionHost& host = parts_->host;
  return std::holds_alternative<ChangeState>(body) && host.phase() != MissionPhase::Held &&
         host.mode() != Mode::Teleop && host.mode() != Mode::Stopped;
}

void OperatorRig::judgeMachineWrite() {
  worked_.insert(parts_->machine.checkpoint().step);
  base_writer_ = arm_writer_ = pumps_writer_ = Writer::Program;
  const MissionHost& host = parts_->host;
  if (host.phase() != MissionPhase::Running) breaks("1: a machine that is held writes a setpoint");
  if (stop_unseen_) return;  // the controllers see it
  if (host.mode() == Mode::Teleop || host.mode() == Mode::Stopped)
    breaks("1: the machine writes in Teleop or under a STOP");
  if (machine_asleep_) breaks("3: the machine moves without having been started or resumed");
}

/// What the gate has let through.
void OperatorRig::judgeCommand(const Command& command) {
  if (!done_.insert(command.nonce).second) breaks("5: a command is done twice");
  if (isSetpoint(command.body) && !isRelease(command.body)) return judgeSetpoint(command);
  const LeaseStatus lease = parts_->authority.lease(now());
  if (!isRelease(command.body) &&
      (lease.holder_client != command.client_id || lease.epoch != command.lease_epoch))
    breaks("5: a command without the lease has an effect");
}

void OperatorRig::judgeSetpoint(const Command& command) {
  const LeaseStatus lease = parts_->authority.lease(now());
  if (lease.holder_client != command.client_id || lease.epoch != command.lease_epoch)
    breaks("5: a setpoint without the lease moves something");
  if (toSeconds(now() - command.issued) > 0.3) breaks("5: a late setpoint moves something");
  if (parts_->host.mode() != Mode::Teleop) breaks("2: a hand moves something outside Teleop");
  const HoldKind kind = *holdKind(command.body);
  if (kind == HoldKind::BaseJog) base_writer_ = Writer::Hand;
  if (kind == HoldKind::ArmJog) arm_writer_ = Writer::Hand;
  if (kind == HoldKind::Actuator) pumps_writer_ = Writer::Hand;
  if (kind == HoldKind::BaseJog) base_asked_ = now();
  if (kind == HoldKind::ArmJog || kind == HoldKind::Macro) arm_asked_ = now();
  if (kind == HoldKind::Actuator || kind == HoldKind::Macro) pumps_asked_ = now();
  asleep_ = false;  // it was pressed since: a STOP ends every press
  if (command.client_id == "ben" && other_over_) breaks("5: a press that was over moves something");
  if (command.client_id != "ann" || command.press == 0) return;
  Press& press = presses_[command.press - 1];
  const std::uint64_t epoch = parts_->authority.epoch().value();
  if (press.over || command.nonce > press.released)
    breaks("5: a press that was over moves something");
  if (press.last && (press.lease != lease.epoch || press.epoch != epoch))
    breaks("5: a press of another lease, mode or epoch moves something");
  if (press.last && toSeconds(now() - *press.last) > kPressOver_s)
    breaks("5: a press goes on after a gap");
  press.last = now();
  press.lease = lease.epoch;
  press.epoch = epoch;
  press.obeyed = true;
  for (std::size_t i = 0; i + 1 < command.press; ++i)
    if (holdKind(presses_[i].body) == kind) presses_[i].over = true;
}

void OperatorRig::noteDone(const Command& command, Mode mode) {
  if (std::holds_alternative<Pause>(command.body)) machine_asleep_ = true;
  const auto* asked = std::get_if<SetMode>(&command.body);
  if (asked && asked->mode == Mode::Teleop) machine_asleep_ = true;
  if ((asked && asked->mode != mode) || std::holds_alternative<ResetRobot>(command.body))
    for (Press& press : presses_) press.over = press.over || press.last;
}

void OperatorRig::judgeTick() {
  parts_->host.check();
  if (acknowledged_ && !parts_->stop.latched()) breaks("4: an acknowledged STOP is gone");
  judgePresses();
  judgeMotion();
  judgeCounters();
  acknowledged_ = other_stop_ = stop_unseen_ = false;
}

/// A press that was refused, or whose macro has ended, is over.
void OperatorRig::judgePresses() {
  for (Press& press : presses_) {
    if (press.sent && !press.obeyed) press.over = true;
    if (press.last && holdKind(press.body) == HoldKind::Macro && !parts_->runner.running())
      press.over = true;
    press.sent = press.obeyed = false;
  }
}

/// The controllers follow who wrote last, and say so.
void OperatorRig::judgeWriters() {
  const Parts& p = *parts_;
  const auto lies = [](const std::optional<Writer>& said, Writer wrote) {
    return said && *said != wrote;
  };
  if (lies(p.base.tracking().writer, base_writer_) || lies(p.arm.tracking().writer, arm_writer_) ||
      lies(p.pumps.tracking().writer, pumps_writer_))
    breaks("2: an actuator follows another writer than the last one");
}

/// Everything that moves does so because somebody asks for it now, or did a moment ago.
void OperatorRig::judgeMotion() {
  const Parts& p = *parts_;
  if (p.host.phase() == MissionPhase::Running && !p.stop.latched())
    base_asked_ = arm_asked_ = pumps_asked_ = now();
  const double tick_s = kControlTicks * toSeconds(kControl);
  const Vector6d q = arm_.trueQ();
  const double turns_radps = (q - std::exchange(q_, q)).cwiseAbs().maxCoeff() / tick_s;
  const Pose2 at = base_.truePose(), before = std::exchange(X_map_base_, at);
  const double drives_mps = std::hypot(at.x_m - before.x_m, at.y_m - before.y_m) / tick_s;
  const auto duty = p.pumps.tracking().duty;
  const auto idle = [this](Stamp asked) {
    return toSeconds(now() - (asleep_ ? std::min(asked, asleep_since_) : asked));
  };
  if (drives_mps > kStill_mps && idle(base_asked_) > kBaseRest_s)
    breaks(asleep_ ? "3: the base moves after a STOP" : "5: the base moves and nobody asks for it");
  if (turns_radps > kStill_radps && idle(arm_asked_) > kArmRest_s)
    breaks(asleep_ ? "3: the arm moves after a STOP" : "5: the arm moves and nobody asks for it");
  if (duty[0] + duty[1] > 0.0 && idle(pumps_asked_) > kPumpsOff_s)
    breaks("6: the pumps run and nobody asks for it");
}

/// Each state in which the machine has worked counts once. After a kill it goes on with the state
/// before; what a reset begins anew does not count.
void OperatorRig::judgeCounters() {
  int visits = 0;
  bool counted = false;
  for (const FsmHistoryEntry& state : parts_->host.log().states()) {
    if (state.cause != TransitionCause::Resume) counted = false;
    counted = counted || state.note.starts_with("reset");
    if (counted || !worked_.contains(state.step)) continue;
    counted = true;
    ++visits;
  }
  if (drill_.visits != visits) breaks("7: a visit was lost or counted twice");
}

}  // namespace kiln
