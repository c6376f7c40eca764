#include "robot/app/run_loop.h"

#include <condition_variable>
#include <csignal>
#include <mutex>

namespace kiln {

std::atomic<int> g_termination_signal{0};

namespace {
void onSignal(int number) { g_termination_signal.store(number); }
}  // namespace

void installSignalHandlers() {
  struct sigaction action = {};
  action.sa_handler = onSignal;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
}

Result<void> runLockstep(SimLink& link, ManualClock& clock, ManualExecutor& executor, Duration step,
                         const std::function<bool()>& done) {
  Stamp next = clock.now();
  while (!done() && g_termination_signal == 0) {
    next += step;
    executor.runUntil(next - Duration{1});  // deliveries that fall between two steps
    if (auto advanced = link.advanceTo(next); !advanced) return advanced;
    executor.runUntil(next);
  }
  return {};
}

void runRealTime(const std::function<bool()>& done) {
  std::mutex mutex;
  std::condition_variable nobody_notifies;
  std::unique_lock lock(mutex);
  while (!done() && g_termination_signal == 0) {
    nobody_notifies.wait_for(lock, std::chrono::milliseconds(20));
  }
}

}  // namespace kiln
