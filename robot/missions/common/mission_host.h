#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/model/status.h"
#include "robot/fsm/machine.h"
#include "robot/safety/command_gate.h"
#include "robot/safety/stop_latch.h"

namespace kiln {

/// The one owner of the seam between mode, STOP and mission: the only way in which a mission
/// starts, pauses, goes on, is forced or restored.
///
///   Idle ---start---> Running ---terminal state---> Ended ---start---> Running
///   Idle -waitFor-> Waiting -start/resume-> Running;  a reason to hold ends the waiting
///   Running ---any reason---> Held ---resume (all reasons go)---> Running
///   Ended --forced state--> Running, or Held while a reason stands
///
/// Reasons are a set, and stand whether a mission runs or not: what is forced or started while one
/// stands waits at the threshold of its state (Machine::pause). Only resume() and start() empty the
/// set; leaving Teleop and clearing a STOP do not, so that nothing moves without a deliberate act.
///
/// What may be asked when is the command gate's to decide (robot/safety/gate_rules.cpp); a request
/// that it would refuse is a bug of the caller and checked here. Confined to the mission thread.
class MissionHost {
 public:
  enum class Wait : std::uint8_t { None, Start, Resume };

  /// @param begin  starts the mission afresh: its clock, its state, its machine.
  MissionHost(Machine& machine, StopLatch& stop, std::function<void(Stamp)> begin);

  /// Starts by itself once the gate lets it (--start).
  void waitForStart() { wait_ = Wait::Start; }
  /// At each tick: what was waited for passes the same gate as an operator's command. Not ready
  /// yet: waits on; any other refusal ends the waiting.
  void goOnWhenAllowed(GateSituation situation, Stamp now);
  /// The machine stands restored (Machine::restore). What ran goes on by itself as --resume asks
  /// for; what was held waits for an operator, a STOP is latched again, and what had ended has
  /// ended.
  /// @param before  what held it when the program ended.
  void restored(const std::vector<MissionHold>& before, Stamp now);
  /// @pre no STOP, no Teleop, no mission under way.
  void start(Stamp now);
  /// @pre no STOP, no Teleop.
  void resume(Stamp now);
  void hold(HoldReason reason, const std::string& text, Stamp now);
  void enterTeleop(const std::string& who, Stamp now);
  /// A mission under way stays held; resume() goes on with it.
  void leaveTeleop(const std::string& who, Stamp now);
  /// @return false, and the STOP stays, if a newer one came. Moves nothing.
  [[nodiscard]] bool clearStop(std::uint64_t generation, Stamp now);
  ChangeStateResult force(const ChangeState& change, const std::string& who, Stamp now);
  /// To be called before anything of a tick is decided. @return true once for each STOP, from
  /// wherever it came.
  [[nodiscard]] bool observeStop(Stamp now);
  /// Checks the invariants: held, stopped or in Teleop the machine stands.
  void check() const;

  [[nodiscard]] Mode mode() const { return stop_.latched() ? Mode::Stopped : mode_; }
  [[nodiscard]] MissionPhase phase() const;
  [[nodiscard]] Wait waiting() const { return wait_; }
  /// Of a mission that is Held or waits to go on.
  [[nodiscard]] std::vector<MissionHold> holds() const;
  /// Why nothing goes on, in words; empty if it does.
  [[nodiscard]] std::string reason() const;
  [[nodiscard]] StatusWord word(bool ready) const;
  /// How often a mission was started.
  [[nodiscard]] int starts() const { return starts_; }

 private:
  void endWaiting(const std::string& why);
  void drop(HoldReason reason, Stamp now);

  Machine& machine_;
  StopLatch& stop_;
  std::function<void(Stamp)> begin_;
  Mode mode_ = Mode::None;
  Wait wait_ = Wait::None;
  std::map<HoldReason, std::string> holds_;
  std::uint64_t stop_seen_ = 0;
  int starts_ = 0;
};

}  // namespace kiln
