#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "common/core/check.h"
#include "tests/fuzz/operator_rig_parts.h"

namespace kiln {
namespace {

constexpr std::array<std::string_view, static_cast<std::size_t>(Act::Count)> kNames{
    "Tick",         "And",          "LinkGap",         "LongSilence", "Stop",
    "LateStop",     "OtherStop",    "MotionWatchStop", "ClearStop",   "ClearOldStop",
    "AcquireLease", "ReleaseLease", "TakeOver",        "JogBase",     "JogArm",
    "HoldPumps",    "HoldMacro",    "RestartMacro",    "HoldNoMacro", "Again",
    "OldPress",     "OldLeaseJog",  "OtherJogs",       "LateJog",     "Replay",
    "Release",      "CancelMacro",  "Teleop",          "Autonomous",  "Start",
    "Pause",        "Resume",       "ForceWork",       "ForceDone",   "ForceOldStep",
    "Finish",       "PositionLost", "PositionFound",   "NotReady",    "Ready",
    "Blind",        "Sees",         "SlowLink",        "FastLink",    "ArmSilent",
    "BaseSilent",   "PumpsSilent",  "ProtectiveStop",  "DevicesBack", "Reset",
    "KillAndResume"};
static_assert(!kNames.back().empty());

constexpr int kGapTicks = 20, kSilenceTicks = 115;

JogArm armJog() {
  JogArm jog;
  jog.frame = JogFrame::Joint;
  jog.velocity[5] = 0.3;
  return jog;
}

CommandBody zeroOf(const CommandBody& body) {
  if (std::holds_alternative<JogBase>(body)) return JogBase{};
  if (std::holds_alternative<JogArm>(body)) return JogArm{};
  if (std::holds_alternative<HoldActuator>(body)) return HoldActuator{kPumps, 0.0};
  return HoldMacro{};
}

}  // namespace

std::string_view nameOf(Act act) { return kNames[static_cast<std::size_t>(act)]; }

Act actOf(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  KILN_CHECK(found != kNames.end(), name);
  return static_cast<Act>(found - kNames.begin());
}

OperatorRig::Sent& OperatorRig::send(CommandBody body, std::uint64_t press, const char* client) {
  Sent sent;
  sent.command.client_id = sent.command.operator_name = client;
  sent.command.nonce = ++nonce_;
  sent.command.lease_epoch = parts_->authority.lease(now()).epoch;
  sent.command.press = press;
  sent.command.body = std::move(body);
  newest_ = sent;
  return batch_.emplace_back(std::move(sent));
}

void OperatorRig::press(CommandBody body) {
  presses_.push_back(Press{body});
  presses_.back().sent = true;
  send(std::move(body), presses_.size());
}

void OperatorRig::goOn(std::size_t presses_back) {
  if (presses_.size() <= presses_back) return;
  Press& press = presses_[presses_.size() - 1 - presses_back];
  press.sent = true;
  send(press.body, presses_.size() - presses_back);
}

void OperatorRig::release() {
  if (!presses_.empty()) send(zeroOf(presses_.back().body), presses_.size());
  send(ReleaseAll{});
  for (Press& press : presses_) press.released = std::min(press.released, nonce_);
}

void OperatorRig::stopBy(const char* who) {
  acknowledged_ = stop_unseen_ = true;
  (void)parts_->stop.set(who, now());
  asleep_ = machine_asleep_ = true;
  asleep_since_ = now();
  for (Press& press : presses_) press.over = true;
  other_over_ = other_over_ || other_sent_;
}

void OperatorRig::force(const char* to, std::uint64_t steps_back) {
  const FsmStatus seen = parts_->machine.status(now());
  send(ChangeState{seen.state, seen.step - std::min(seen.step, steps_back), to});
}

void OperatorRig::quiet(int ticks, bool heard) {
  for (int i = 0; i < ticks; ++i) tick(heard);
}

void OperatorRig::give(Act act) {
  switch (act) {
    case Act::LinkGap:
      return quiet(kGapTicks, true);
    case Act::LongSilence:
      return quiet(kSilenceTicks, false);
    case Act::KillAndResume:
      return killAndResume();
    default:
      giveCommand(act);
      giveEvent(act);
  }
}

void OperatorRig::giveCommand(Act act) {
  const std::uint64_t generation = parts_->stop.generation();
  switch (act) {
    case Act::OtherStop:
      other_stop_ = true;
      send(ClearStop{generation});
      break;
    case Act::ClearStop:
      send(ClearStop{generation});
      break;
    case Act::ClearOldStop:
      send(ClearStop{generation - std::min<std::uint64_t>(generation, 1)});
      break;
    case Act::AcquireLease:
      send(AcquireLease{});
      break;
    case Act::ReleaseLease:
      send(ReleaseLease{});
      break;
    case Act::TakeOver:
      send(AcquireLease{true}, 0, "ben");
      break;
    case Act::JogBase:
      return press(JogBase{{0.3, 0, 0}});
    case Act::JogArm:
      return press(armJog());
    case Act::HoldPumps:
      return press(HoldActuator{kPumps, 1.0});
    case Act::HoldMacro:
    case Act::RestartMacro:
      return press(HoldMacro{"spray", act == Act::RestartMacro});
    case Act::HoldNoMacro:
      return press(HoldMacro{"dance", false});
    case Act::Again:
      return goOn(0);
    case Act::OldPress:
      return goOn(1);
    case Act::OldLeaseJog:
      press(JogBase{{0.3, 0, 0}});
      --batch_.back().command.lease_epoch;
      presses_.back().sent = false;
      break;
    case Act::OtherJogs:
      send(JogBase{{0.3, 0, 0}}, 1, "ben");
      other_sent_ = true;
      break;
    case Act::LateJog:
      press(JogBase{{0.3, 0, 0}});
      batch_.back().age = std::chrono::milliseconds(500);
      break;
    case Act::Replay:
      if (newest_) batch_.push_back(*newest_);
      break;
    case Act::Release:
      return release();
    case Act::CancelMacro:
      send(kiln::CancelMacro{});
      break;
    case Act::Teleop:
      send(SetMode{Mode::Teleop});
      break;
    case Act::Autonomous:
      send(SetMode{Mode::Autonomous});
      break;
    case Act::Start:
      send(StartMission{});
      break;
    case Act::Pause:
      send(kiln::Pause{});
      break;
    case Act::Resume:
      send(kiln::Resume{});
      break;
    case Act::ForceWork:
      return force("DrillWork", 0);
    case Act::ForceDone:
      return force("DrillDone", 0);
    case Act::ForceOldStep:
      return force("DrillWork", 1);
    case Act::Reset:
      send(ResetRobot{});
      break;
    default:
      break;
  }
}

void OperatorRig::giveEvent(Act act) {
  switch (act) {
    case Act::Stop:
      return stopBy("Ann");
    case Act::MotionWatchStop:
      return stopBy("motion watch");
    case Act::LateStop:
      late_stop_ = true;
      return;
    case Act::Finish:
      drill_.finished = !drill_.finished;
      return;
    case Act::PositionLost:
    case Act::PositionFound:
      located_ = act == Act::PositionFound;
      return;
    case Act::NotReady:
    case Act::Ready:
      ready_ = act == Act::Ready;
      return;
    case Act::Blind:
    case Act::Sees:
      sees_ = act == Act::Sees;
      return;
    case Act::SlowLink:
    case Act::FastLink:
      slow_ = act == Act::SlowLink;
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
      send(ReleaseProtectiveStop{});
      return;
    default:
      return;
  }
}

/// The daemon is killed and goes on from what is on disk, where a STOP is with the tick after it;
/// operators start anew.
void OperatorRig::killAndResume() {
  tick();
  tick();  // one of the tick before may be a late STOP
  if (saved_.empty()) return;
  const auto checkpoint = decodeCheckpoint(saved_, "saved");
  if (!checkpoint) return breaks("7: the checkpoint cannot be read");
  worked_.erase(worked_.upper_bound(checkpoint->fsm.step), worked_.end());
  build();
  const auto restored = parts_->host.restore(*checkpoint, now());
  if (!restored || parts_->machine.info().mission_uuid != checkpoint->fsm.mission_uuid ||
      parts_->belief.clock_start != checkpoint->robot.clock_start ||
      parts_->mission.save() != *checkpoint->mission)
    breaks("7: id, clock or database of the mission were lost");
  const bool stood = !parts_->machine.running() || !checkpoint->holds.empty();
  if (stood && !asleep_) asleep_since_ = now();
  asleep_ = asleep_ || stood;
  machine_asleep_ = machine_asleep_ || stood;
  batch_.clear();
  newest_.reset();
  presses_.clear();
  other_sent_ = other_over_ = false;
}

}  // namespace kiln
