#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "common/core/error.h"
#include "common/core/stamp.h"
#include "common/model/command.h"
#include "common/model/fsm.h"

namespace kiln {

/// What has to survive a restart of the program. `state` is where the mission stood, `resume_state`
/// where it goes on (the same, unless the state named another one at compile time).
struct FsmCheckpoint {
  std::string mission;
  std::string mission_uuid;
  std::uint64_t step = 0;
  std::string state;
  std::string resume_state;
  bool arrived = true;  ///< false: gone to while held, and not let go yet
};

/// A running finite state machine without its types: what app, telemetry and the command gate see.
/// Confined to the mission thread, except blocked() and info(), which any thread may call.
class Machine {
 public:
  virtual ~Machine() = default;

  /// The graph; constant over the machine's life but for the mission UUID.
  [[nodiscard]] virtual FsmInfo info() const = 0;
  [[nodiscard]] virtual FsmStatus status(Stamp now) const = 0;
  /// Watchdog, from any thread: "AimHose::execute has not returned for 1.2 s", or empty.
  [[nodiscard]] virtual std::string blocked() const = 0;

  /// Enters the start state, under a new mission UUID unless `mission_uuid` is empty. Nothing
  /// happens if the mission runs already.
  virtual void start(const std::string& mission_uuid, Stamp now) = 0;
  /// Polls the current state once, at 50 Hz; at most one transition a step. Nothing while paused or
  /// ended.
  virtual void step(Stamp now) = 0;
  /// Holds the machine, whether it runs or not: what is started, forced or restored while it is
  /// held waits at the threshold of its state and moves nothing. The state's pause() hook brings
  /// the robot to rest; the time in the state stands still.
  virtual void pause(std::string why, Stamp now) = 0;
  /// Lets go: a state at whose threshold the machine waits is entered now, else the state's
  /// resume() hook runs.
  virtual void resume(Stamp now) = 0;
  [[nodiscard]] virtual bool held() const = 0;
  [[nodiscard]] virtual bool running() const = 0;  ///< begun, and in no terminal state
  [[nodiscard]] virtual bool begun() const = 0;    ///< started or restored once
  /// By hand: compare-and-set on the step counter and the name of the state that the operator saw.
  virtual ChangeStateResult changeState(const ChangeState& change, const std::string& operator_name,
                                        Stamp now) = 0;
  /// Back to the start state within the same mission: the robot was carried to its start
  /// (competition reset).
  virtual void restart(std::string why, Stamp now) = 0;

  [[nodiscard]] virtual FsmCheckpoint checkpoint() const = 0;
  /// Stands where a checkpoint stood, under its mission UUID and held: resume() enters the state.
  /// Where the state may not be entered as things are (State::denyEntry), the start state takes its
  /// place. Error: another mission's checkpoint, unknown state.
  [[nodiscard]] virtual Result<void> restore(const FsmCheckpoint& checkpoint, Stamp now) = 0;
  /// Called after each transition, i.e. after each action.
  virtual void onTransition(std::function<void(const FsmCheckpoint&)> hook) = 0;
};

}  // namespace kiln
