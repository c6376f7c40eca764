#include "robot/app/run_loop.h"

#include <condition_variable>
#include <csignal>
#include <mutex>

#include "common/core/log.h"

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
  Stamp next = clock.now() + step;
  Result<void> stepped = link.beginStep(next);
  while (stepped && !done() && g_termination_signal == 0) {
    executor.runUntil(next - Duration{1});  // deliveries that fall between two steps
    stepped = link.finishStep();
    if (stepped) stepped = link.beginStep(next + step);
    if (stepped) executor.runUntil(next);
    next += step;
  }
  return stepped;
}

namespace {

void deliverAt(RecordedRun& run, ManualExecutor& executor, const RecordedMessage& message) {
  executor.runUntil(message.logged);
  if (auto delivered = run.deliver(message); !delivered)
    logger("replay")->warn("{}", delivered.error().message);
}

void replayAtOnce(RecordedRun& run, ManualExecutor& executor, const std::function<bool()>& done) {
  auto cursor = run.player().messages();
  while (!done() && g_termination_signal == 0) {
    const auto message = cursor.next();
    if (!message) {
      logger("replay")->warn("{}", message.error().message);
    } else if (!*message) {
      return;
    } else {
      deliverAt(run, executor, **message);
    }
  }
}

}  // namespace

void runReplay(RecordedRun& run, ManualExecutor& executor, double speed,
               const std::function<bool()>& done) {
  if (speed <= 0.0) return replayAtOnce(run, executor, done);
  constexpr std::size_t kAtOnce = 100;  // then signals and stations are looked at
  Player& player = run.player();
  player.setSpeed(speed);
  player.play();
  std::mutex mutex;
  std::condition_variable nobody_notifies;
  std::unique_lock lock(mutex);
  while (!done() && g_termination_signal == 0) {
    const auto played = player.poll(
        [&](const RecordedMessage& message) { deliverAt(run, executor, message); }, kAtOnce);
    if (!played) logger("replay")->warn("{}", played.error().message);
    executor.runUntil(player.position());
    if (player.ended()) return;
    if (played && *played < kAtOnce) nobody_notifies.wait_for(lock, std::chrono::milliseconds(4));
  }
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
