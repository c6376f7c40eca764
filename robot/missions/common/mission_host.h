#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/core/clock.h"
#include "robot/missions/common/checkpoint_keeper.h"
#include "robot/missions/common/mission.h"
#include "robot/missions/common/mission_log.h"
#include "robot/safety/command_gate.h"
#include "robot/safety/stop_latch.h"

namespace kiln {

/// The one owner of the seam between mode, STOP and mission: the only way in which a mission
/// starts, pauses, goes on, is forced, reset, kept on disk or restored.
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

  /// All outlive the host.
  MissionHost(Mission& mission, RobotBelief& belief, StopLatch& stop, const Clock& clock,
              CheckpointKeeper::Config checkpoint = {});

  /// Starts by itself once the gate lets it (--start).
  void waitForStart() { wait_ = Wait::Start; }
  /// At each tick: what was waited for passes the same gate as an operator's command. Not ready
  /// yet: waits on; any other refusal ends the waiting.
  void goOnWhenAllowed(GateSituation situation, Stamp now);
  [[nodiscard]] MissionCheckpoint checkpoint() const;
  /// Takes over a checkpoint; moves and starts nothing. What ran goes on by itself once the gate
  /// lets it (--resume); what was held waits for an operator, a STOP is latched again, and what had
  /// ended has ended. Error: of another mission, or damaged; the host is of no use then.
  [[nodiscard]] Result<void> restore(const MissionCheckpoint& saved, Stamp now);
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
  /// The robot was carried to its start: the mission begins its states anew and keeps its clock and
  /// what it knows.
  void onReset(Stamp now);
  /// Once a tick: what the mission sees, one step of its machine, its checkpoint. Held, it keeps
  /// books and moves nothing.
  void tick(Stamp now);
  /// Checks the invariants: held, stopped or in Teleop the machine stands.
  void check() const;
  /// Why the checkpoint is not kept.
  [[nodiscard]] std::optional<Error> storageProblem() const { return keeper_.problem(); }
  /// Waits until the newest checkpoint was tried.
  void flushCheckpoint() { keeper_.flush(); }

  [[nodiscard]] Mission& mission() const { return mission_; }
  /// Of the machine, as the last tick left it.
  [[nodiscard]] const FsmStatus& fsm() const { return fsm_; }
  [[nodiscard]] const MissionLog& log() const { return log_; }

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
  void keepTransitions();
  void begin(Stamp now);
  /// @param before  what held it when the program ended.
  void hold(const std::vector<MissionHold>& before, Stamp now);
  void endWaiting(const std::string& why);
  void drop(HoldReason reason, Stamp now);

  Mission& mission_;
  Machine& machine_;
  RobotBelief& belief_;
  StopLatch& stop_;
  const Clock& clock_;
  MissionLog log_;
  FsmStatus fsm_;
  Mode mode_ = Mode::None;
  Wait wait_ = Wait::None;
  std::map<HoldReason, std::string> holds_;
  std::uint64_t stop_seen_ = 0;
  int starts_ = 0;
  CheckpointKeeper keeper_;  ///< last: its end writes what is left
};

}  // namespace kiln
