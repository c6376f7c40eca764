#include "robot/missions/common/mission_host.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/core/check.h"
#include "common/core/log.h"
#include "robot/fsm/uuid.h"
#include "robot/safety/gate_rules.h"

namespace kiln {

MissionHost::MissionHost(Mission& mission, RobotBelief& belief, StopLatch& stop, const Clock& clock,
                         CheckpointKeeper::Config checkpoint)
    : mission_(mission),
      machine_(mission.machine()),
      belief_(belief),
      stop_(stop),
      clock_(clock),
      keeper_(std::move(checkpoint), [this] {
        log_.observe(machine_.status(clock_.now()));
        return this->checkpoint();
      }) {
  keepTransitions();
}

void MissionHost::keepTransitions() {
  machine_.onTransition([this](const FsmCheckpoint&) { keeper_.onTransition(clock_.now()); });
}

MissionCheckpoint MissionHost::checkpoint() const {
  MissionCheckpoint out;
  out.stamp = clock_.now();
  out.fsm = machine_.checkpoint();
  // Waiting for its sensors after a restart, a mission runs as far as the next restart goes.
  if (wait_ == Wait::None) out.holds = holds();
  out.robot = belief_;
  out.log = std::make_shared<const nlohmann::json>(log_.save());
  out.mission = std::make_shared<const nlohmann::json>(mission_.save());
  return out;
}

Result<void> MissionHost::restore(const MissionCheckpoint& saved, Stamp now) {
  const Duration shift = now < saved.stamp ? now - saved.stamp : Duration{};
  KILN_CHECK(saved.log && saved.mission);  // whoever decodes it fills them
  if (auto log = log_.restore(*saved.log, saved.stamp, shift); !log) return log;
  if (auto mission = mission_.restore(*saved.mission); !mission) return mission;
  belief_ = saved.robot;
  belief_.continueClock(saved.stamp, now);
  machine_.onTransition({});  // nothing is kept before it is known why the mission stood
  auto machine = machine_.restore(saved.fsm, now);
  keepTransitions();
  if (!machine) return machine;
  hold(saved.holds, now);
  fsm_ = machine_.status(now);
  return {};
}

void MissionHost::goOnWhenAllowed(GateSituation situation, Stamp now) {
  if (wait_ == Wait::None) return;
  GateDecision decision = gate::checkSituation(StartMission{}, situation);
  // A restored mission is as good as held; what resumes it must find the robot ready as well.
  situation.phase = MissionPhase::Held;
  if (wait_ == Wait::Resume && decision.accepted)
    decision = gate::checkSituation(Resume{}, situation);
  if (!decision.accepted) {
    if (decision.code != "not_ready" && decision.code != "position_lost")
      hold(HoldReason::OperatorPause, decision.reason, now);
  } else if (wait_ == Wait::Start) {
    start(now);
  } else {
    resume(now);
    logger("mission")->warn("mission resumed from its checkpoint");
  }
}

void MissionHost::hold(const std::vector<MissionHold>& before, Stamp now) {
  if (!machine_.running()) return machine_.resume(now);
  hold(HoldReason::Restored, "restored from its checkpoint", now);
  if (before.empty()) wait_ = Wait::Resume;
  for (const MissionHold& was : before) {
    if (was.reason == HoldReason::Stop)
      (void)stop_.set(was.text + ", before the restart", now);
    else if (was.reason == HoldReason::Teleop)
      hold(HoldReason::OperatorPause, was.text + ", before the restart", now);
    else
      hold(was.reason, was.text, now);
  }
}

void MissionHost::start(Stamp now) {
  KILN_CHECK(!stop_.latched() && mode_ != Mode::Teleop && !machine_.running());
  wait_ = Wait::None;
  holds_.clear();
  machine_.resume(now);  // nothing runs: only lets go
  mode_ = Mode::Autonomous;
  ++starts_;
  begin(now);
  logger("mission")->info("mission started");
}

void MissionHost::begin(Stamp now) {
  const bool again = machine_.begun();
  if (again) mission_.beginAnew(now);
  belief_.startClock(now);
  log_.begin(now);
  machine_.start(again ? randomUuid() : std::string(), now);
}

void MissionHost::resume(Stamp now) {
  KILN_CHECK(!stop_.latched() && mode_ != Mode::Teleop);
  wait_ = Wait::None;
  holds_.clear();
  mode_ = Mode::Autonomous;
  machine_.resume(now);
}

void MissionHost::hold(HoldReason reason, const std::string& text, Stamp now) {
  if (wait_ != Wait::None) endWaiting(text);
  holds_.insert_or_assign(reason, text);
  machine_.pause(text, now);
}

void MissionHost::endWaiting(const std::string& why) {
  logger("mission")->warn("the {} asked for at the program's start is off: {}; an operator decides",
                          wait_ == Wait::Start ? "start" : "resume", why);
  wait_ = Wait::None;
}

void MissionHost::drop(HoldReason reason, Stamp now) {
  holds_.erase(reason);
  if (holds_.empty()) machine_.resume(now);
}

void MissionHost::enterTeleop(const std::string& who, Stamp now) {
  hold(HoldReason::Teleop, who + " drives by hand", now);
  mode_ = Mode::Teleop;
}

void MissionHost::leaveTeleop(const std::string& who, Stamp now) {
  if (mode_ != Mode::Teleop) return;
  mode_ = machine_.running() ? Mode::Autonomous : Mode::None;
  if (machine_.running())
    hold(HoldReason::OperatorPause, "given back by " + who + "; resume it to go on", now);
  drop(HoldReason::Teleop, now);
}

bool MissionHost::clearStop(std::uint64_t generation, Stamp now) {
  if (!stop_.clear(generation)) return false;
  if (!machine_.running()) drop(HoldReason::Stop, now);
  return true;
}

ChangeStateResult MissionHost::force(const ChangeState& change, const std::string& who, Stamp now) {
  const ChangeStateResult result = machine_.changeState(change, who, now);
  if (result.outcome == ChangeStateOutcome::Ok && mode_ == Mode::None) mode_ = Mode::Autonomous;
  return result;
}

bool MissionHost::observeStop(Stamp now) {
  const std::uint64_t generation = stop_.generation();
  if (!stop_.latched() || generation == stop_seen_) return false;
  stop_seen_ = generation;
  hold(HoldReason::Stop, "STOP by " + stop_.source(), now);
  return true;
}

void MissionHost::onReset(Stamp now) {
  ++belief_.resets;
  mission_.onReset(now);
  if (machine_.running()) machine_.restart(fmt::format("reset {}", belief_.resets), now);
}

void MissionHost::tick(Stamp now) {
  check();
  mission_.observe(now);
  machine_.step(now);
  fsm_ = machine_.status(now);
  log_.observe(fsm_);
  if (machine_.running())
    keeper_.tick(wait_ == Wait::None ? holds() : std::vector<MissionHold>{}, now);
}

void MissionHost::check() const {
  KILN_CHECK(machine_.held() == !holds_.empty(), "the machine is held for a reason, and only then");
  KILN_CHECK(mode_ != Mode::Teleop || machine_.held(), "in Teleop the machine stands");
}

MissionPhase MissionHost::phase() const {
  if (wait_ != Wait::None) return MissionPhase::Waiting;
  if (machine_.running()) return machine_.held() ? MissionPhase::Held : MissionPhase::Running;
  return machine_.begun() ? MissionPhase::Ended : MissionPhase::Idle;
}

std::vector<MissionHold> MissionHost::holds() const {
  std::vector<MissionHold> out;
  if (machine_.running())
    for (const auto& [reason, text] : holds_) out.push_back({reason, text});
  return out;
}

std::string MissionHost::reason() const {
  if (stop_.latched()) return "STOP by " + stop_.source();
  if (const auto teleop = holds_.find(HoldReason::Teleop); teleop != holds_.end())
    return teleop->second;
  return machine_.running() && !holds_.empty() ? holds_.begin()->second : std::string();
}

StatusWord MissionHost::word(bool ready) const {
  if (stop_.latched()) return StatusWord::Stopped;
  if (mode_ == Mode::Teleop) return StatusWord::Teleop;
  switch (phase()) {
    case MissionPhase::Running:
      return StatusWord::Auto;
    case MissionPhase::Held:
      return StatusWord::Paused;
    case MissionPhase::Waiting:
      return machine_.running() ? StatusWord::Paused
             : ready            ? StatusWord::Ready
                                : StatusWord::NotReady;
    case MissionPhase::Idle:
    case MissionPhase::Ended:
      break;
  }
  return ready ? StatusWord::Ready : StatusWord::NotReady;
}

}  // namespace kiln
