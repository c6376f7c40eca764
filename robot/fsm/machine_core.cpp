#include "robot/fsm/machine_core.h"

#include <utility>

#include <fmt/format.h>

#include "common/core/check.h"
#include "robot/fsm/uuid.h"

namespace kiln {
namespace {

FsmInfo makeInfo(const MachineCore::Options& options, const std::vector<StateEntry>& entries) {
  FsmInfo info;
  info.mission = options.mission;
  info.mission_uuid = options.mission_uuid.empty() ? randomUuid() : options.mission_uuid;
  info.start_state = entries.front().info.name;
  for (const StateEntry& from : entries) {
    info.states.push_back(from.info);
    for (const std::string& target : from.targets) {
      FsmEdgeInfo edge{from.info.name, target, target == from.info.timeout_target, {}};
      for (const StateEntry& to : entries)
        if (to.info.name == target) edge.consequence = to.consequence;
      info.edges.push_back(std::move(edge));
    }
  }
  return info;
}

}  // namespace

MachineCore::MachineCore(Options options, const Clock& clock, std::vector<StateEntry> entries)
    : info_(makeInfo(options, entries)),
      options_(std::move(options)),
      watchdog_(clock, options_.watchdog_limit),
      entries_(std::move(entries)) {}

FsmStatus MachineCore::status(Stamp now) const {
  FsmStatus status;
  status.stamp = now;
  status.mission_uuid = info_.mission_uuid;
  status.step = step_;
  status.history.assign(history_.begin(), history_.end());
  status.blocked = blocked();
  if (!current_) return status;
  status.state = current_->name();
  status.entered = entered_;
  status.paused_in_state = paused_in_state_ + (paused() ? now - paused_since_ : Duration{});
  status.running = running_;
  status.paused = paused();
  status.terminal = entry().info.terminal;
  status.success = status.terminal && entry().info.success;
  status.display_text = paused() ? fmt::format("Paused: {}", pause_reason_) : display_;
  status.guards = guards_;
  for (GuardStatus& guard : status.guards)
    if (guard.input_age_s >= 0.0) guard.input_age_s += toSeconds(now - guards_stamp_);
  return status;
}

void MachineCore::start(const std::string& mission_uuid, Stamp now) {
  if (running_) return;
  now_ = now;
  if (!mission_uuid.empty()) info_.mission_uuid = mission_uuid;
  history_.clear();
  go(entries_.front().make(), TransitionCause::Start, {});
}

void MachineCore::step(Stamp now) {
  now_ = now;
  if (!running_ || held_) return;
  guards_.clear();
  guards_stamp_ = now;
  Transition transition = poll();
  if (!transition.stays()) {
    go(std::move(transition.next_), TransitionCause::Normal, std::move(transition.note_));
  } else if (timedOut()) {
    const StateEntry* target = find(entry().info.timeout_target);
    go(target->make(), TransitionCause::Timeout,
       fmt::format("{} took longer than {:.0f} s", entry().info.label, entry().info.time_limit_s));
  }
}

Transition MachineCore::poll() {
  {
    const Watchdog::Call call(watchdog_, current_->name(), "watch");
    Transition interrupt = current_->watch();
    if (!interrupt.stays()) return interrupt;
  }
  const Watchdog::Call call(watchdog_, current_->name(), "execute");
  return current_->execute();
}

bool MachineCore::timedOut() const {
  return !entry().info.timeout_target.empty() &&
         toSeconds(timeInState()) >= entry().info.time_limit_s;
}

void MachineCore::go(std::unique_ptr<AnyState> next, TransitionCause cause, std::string note) {
  KILN_CHECK(next != nullptr);
  if (current_ && running_ && !enter_pending_) {
    const Watchdog::Call call(watchdog_, current_->name(), "leave");
    current_->leave();
  }
  if (!history_.empty()) history_.back().left = now_;
  current_ = std::move(next);
  current_->setHost(this);
  ++step_;
  entered_ = now_;
  paused_since_ = now_;
  paused_in_state_ = {};
  guards_.clear();
  guards_stamp_ = now_;
  display_.clear();
  running_ = !entry().info.terminal;
  recordEntry(cause, std::move(note));
  arrive_pending_ = cause != TransitionCause::Resume;
  enter_pending_ = paused();
  if (!enter_pending_) enterCurrent();
  if (transition_hook_) transition_hook_(checkpoint());
}

void MachineCore::enterCurrent() {
  enter_pending_ = false;
  const Watchdog::Call call(watchdog_, current_->name(), "enter");
  if (std::exchange(arrive_pending_, false)) current_->arrive();
  current_->enter();
}

void MachineCore::recordEntry(TransitionCause cause, std::string note) {
  history_.push_back({step_, std::string(current_->name()), now_, Stamp{}, cause, std::move(note)});
  while (history_.size() > options_.history_length) history_.pop_front();
}

void MachineCore::pause(std::string why, Stamp now) {
  now_ = now;
  pause_reason_ = std::move(why);
  if (std::exchange(held_, true) || !running_) return;
  paused_since_ = now;
  const Watchdog::Call call(watchdog_, current_->name(), "pause");
  current_->pause();
}

void MachineCore::resume(Stamp now) {
  now_ = now;
  if (!std::exchange(held_, false) || !running_) return;
  paused_in_state_ += now - paused_since_;
  if (enter_pending_) return enterCurrent();
  const Watchdog::Call call(watchdog_, current_->name(), "resume");
  current_->resume();
}

ChangeStateResult MachineCore::changeState(const ChangeState& change,
                                           const std::string& operator_name, Stamp now) {
  if (!current_)
    return {ChangeStateOutcome::Denied, "the mission has not been started; start it first"};
  const StateEntry* target = find(change.to);
  if (target == nullptr)
    return {ChangeStateOutcome::NoSuchState,
            fmt::format("mission '{}' has no state '{}'", info_.mission, change.to)};
  if (change.from != current_->name() || change.step != step_)
    return {ChangeStateOutcome::Moved,
            fmt::format("the state was no longer {} (step {}) but {} (step {}); look again",
                        change.from, change.step, current_->name(), step_)};
  if (!target->info.enterable)
    return {ChangeStateOutcome::NeedsArguments, target->info.not_enterable_reason};
  if (target->deny) {
    if (std::string reason = target->deny(); !reason.empty())
      return {ChangeStateOutcome::Denied, std::move(reason)};
  }
  now_ = now;
  go(target->make(), TransitionCause::Operator, fmt::format("by {}", operator_name));
  return {ChangeStateOutcome::Ok, {}};
}

void MachineCore::restart(std::string why, Stamp now) {
  now_ = now;
  go(entries_.front().make(), TransitionCause::Resume, std::move(why));
}

FsmCheckpoint MachineCore::checkpoint() const {
  FsmCheckpoint out{info_.mission, info_.mission_uuid, step_, {}, {}, !arrive_pending_};
  if (!current_) return out;
  out.state = current_->name();
  out.resume_state = entry().resume_state;
  return out;
}

Result<void> MachineCore::restore(const FsmCheckpoint& checkpoint, Stamp now) {
  if (checkpoint.mission != info_.mission)
    return makeError(ErrorCode::InvalidInput,
                     "the checkpoint belongs to mission '{}', not to '{}'; start without --resume",
                     checkpoint.mission, info_.mission);
  const StateEntry* stood = find(checkpoint.state);
  if (stood == nullptr)
    return makeError(ErrorCode::VersionMismatch,
                     "the checkpoint stands in state '{}', which mission '{}' does not have; start "
                     "without --resume",
                     checkpoint.state, info_.mission);
  const StateEntry* target = find(stood->resume_state);
  KILN_CHECK(target != nullptr && target->make, stood->resume_state);
  std::string note = fmt::format("resumed; stood in {}", checkpoint.state);
  if (target->deny) {
    if (const std::string denied = target->deny(); !denied.empty()) {
      note += fmt::format(", where it cannot go on: {}", denied);
      target = &entries_.front();
    }
  }
  now_ = now;
  info_.mission_uuid = checkpoint.mission_uuid;
  step_ = checkpoint.step;
  pause("restored from a checkpoint", now);
  go(target->make(), TransitionCause::Resume, std::move(note));
  arrive_pending_ = target == stood && !checkpoint.arrived;
  return {};
}

void MachineCore::onTransition(std::function<void(const FsmCheckpoint&)> hook) {
  transition_hook_ = std::move(hook);
}

Duration MachineCore::timeInState() const {
  const Stamp until = paused() ? paused_since_ : now_;
  return until - entered_ - paused_in_state_;
}

void MachineCore::addGuard(std::string name, bool met, std::string detail, double input_age_s) {
  for (GuardStatus& guard : guards_) {
    if (guard.name != name) continue;
    guard = {std::move(name), met, std::move(detail), input_age_s};  // judged twice in a step
    return;
  }
  guards_.push_back({std::move(name), met, std::move(detail), input_age_s});
}

const StateEntry* MachineCore::find(const std::string& name) const {
  for (const StateEntry& candidate : entries_)
    if (candidate.info.name == name) return &candidate;
  return nullptr;
}

const StateEntry& MachineCore::entry() const {
  const StateEntry* found = find(std::string(current_->name()));
  KILN_CHECK(found != nullptr, current_->name());
  return *found;
}

}  // namespace kiln
