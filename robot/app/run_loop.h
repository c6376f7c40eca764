#pragma once

#include <atomic>
#include <functional>

#include "common/core/manual_executor.h"
#include "common/core/thread_executor.h"
#include "robot/app/recorded_run.h"
#include "robot/sim_link/sim_link.h"

namespace kiln {

/// Set by SIGINT, SIGTERM and SIGHUP.
extern std::atomic<int> g_termination_signal;
void installSignalHandlers();

/// Lockstep: world and robot step together in periods of `step` until `done` or a signal. Events of
/// the robot at the end of each period see the world's report of that very instant; the world is
/// already making the next step meanwhile (two processors), so a command takes effect one step
/// later, as it does behind a servo loop.
[[nodiscard]] Result<void> runLockstep(SimLink& link, ManualClock& clock, ManualExecutor& executor,
                                       Duration step, const std::function<bool()>& done);

/// Plays a recording at `speed` times its pace (0: as fast as possible) until its end, `done` or a
/// signal. Robot time is the recording's.
void runReplay(RecordedRun& run, ManualExecutor& executor, double speed,
               const std::function<bool()>& done);

/// Real time: waits for `done` or a signal while the executor's threads work.
void runRealTime(const std::function<bool()>& done);

}  // namespace kiln
