#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "common/core/clock.h"
#include "common/core/executor.h"
#include "common/core/mutex.h"

namespace kiln {

/// Real time: one named thread a tick, a small pool for jobs. Ticks up to kPriorityControl run
/// before the machine's ordinary threads where that is allowed (scheduling.h). every() before
/// start(); post() at any time and from any thread. stop() (or the destructor) joins all threads;
/// nothing is detached.
class ThreadExecutor final : public Executor {
 public:
  ThreadExecutor(const Clock& clock, int pool_threads);
  ~ThreadExecutor() override;
  ThreadExecutor(const ThreadExecutor&) = delete;
  ThreadExecutor& operator=(const ThreadExecutor&) = delete;

  bool post(Job job) override;
  void every(Duration period, std::string name, int priority,
             std::function<void(Stamp)> tick) override;
  void start();
  void stop();
  [[nodiscard]] std::vector<TickStatistics> statistics() const override;
  [[nodiscard]] std::uint64_t droppedJobs() const override;

 private:
  struct Periodic {
    Duration period;
    int priority;
    std::function<void(Stamp)> tick;
    TickStatistics statistics;
  };
  void runPeriodic(std::stop_token stop, Periodic& periodic);
  void runPool(std::stop_token stop);

  const Clock& clock_;
  int pool_threads_;
  mutable Mutex mutex_;
  // Two, because a wake-up must not reach one that it is not meant for: a tick that takes the
  // pool's leaves a job lying.
  std::condition_variable_any wake_tick_;  ///< end of the program; a tick else waits for its time
  std::condition_variable_any wake_pool_;  ///< a job, or the end
  std::deque<Job> jobs_;
  std::set<std::string> kinds_in_flight_;
  std::uint64_t dropped_jobs_ = 0;
  std::vector<std::unique_ptr<Periodic>> periodics_;
  std::vector<std::jthread> threads_;
};

}  // namespace kiln
