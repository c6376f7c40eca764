#include "common/core/thread_executor.h"

#include <algorithm>

#include <pthread.h>

#include "common/core/check.h"
#include "common/core/scheduling.h"

namespace kiln {
namespace {
void nameThisThread(const std::string& name) {
  pthread_setname_np(pthread_self(), name.substr(0, 15).c_str());  // Linux limit: 15 characters
}
}  // namespace

ThreadExecutor::ThreadExecutor(const Clock& clock, int pool_threads)
    : clock_(clock), pool_threads_(pool_threads) {}

ThreadExecutor::~ThreadExecutor() { stop(); }

bool ThreadExecutor::post(Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (!kinds_in_flight_.insert(job.kind).second) {
      ++dropped_jobs_;
      return false;
    }
    jobs_.push_back(std::move(job));
  }
  wake_pool_.notify_one();
  return true;
}

void ThreadExecutor::every(Duration period, std::string name, int priority,
                           std::function<void(Stamp)> tick) {
  KILN_CHECK(threads_.empty(), "every() after start()", name);
  TickStatistics statistics;
  statistics.name = std::move(name);
  periodics_.push_back(
      std::make_unique<Periodic>(Periodic{period, priority, std::move(tick), statistics}));
}

void ThreadExecutor::start() {
  for (auto& periodic : periodics_) {
    threads_.emplace_back(
        [this, &periodic = *periodic](std::stop_token stop) { runPeriodic(stop, periodic); });
  }
  for (int i = 0; i < pool_threads_; ++i) {
    threads_.emplace_back([this, i](std::stop_token stop) {
      nameThisThread(fmt::format("pool.{}", i));
      runPool(stop);
    });
  }
}

void ThreadExecutor::stop() {
  for (auto& thread : threads_) thread.request_stop();
  wake_tick_.notify_all();
  wake_pool_.notify_all();
  threads_.clear();  // joins
}

void ThreadExecutor::runPeriodic(std::stop_token stop, Periodic& periodic) {
  nameThisThread(periodic.statistics.name);
  if (periodic.priority <= kPriorityControl) runBeforeOthers();
  std::unique_lock lock(mutex_);
  Stamp due = clock_.now() + periodic.period;
  while (!stop.stop_requested()) {
    const Duration wait = due - clock_.now();
    if (wait > Duration::zero()) {
      wake_tick_.wait_for(lock, stop, wait, [&] { return clock_.now() >= due; });
      if (stop.stop_requested()) return;
      if (clock_.now() < due) continue;
    }
    const Stamp now = clock_.now();
    const double late_s = toSeconds(now - due);
    periodic.statistics.worst_late_s = std::max(periodic.statistics.worst_late_s, late_s);
    ++periodic.statistics.ticks;
    const auto missed = (now - due) / periodic.period;
    periodic.statistics.slips += static_cast<std::uint64_t>(missed);
    due += (missed + 1) * periodic.period;
    lock.unlock();
    periodic.tick(now);
    lock.lock();
  }
}

void ThreadExecutor::runPool(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  while (wake_pool_.wait(lock, stop, [this] { return !jobs_.empty(); })) {
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    if (Delivery deliver = job.run(stop)) deliver();
    lock.lock();
    kinds_in_flight_.erase(job.kind);
  }
}

std::vector<TickStatistics> ThreadExecutor::statistics() const {
  const std::lock_guard lock(mutex_);
  std::vector<TickStatistics> out;
  for (const auto& periodic : periodics_) out.push_back(periodic->statistics);
  return out;
}

std::uint64_t ThreadExecutor::droppedJobs() const {
  const std::lock_guard lock(mutex_);
  return dropped_jobs_;
}

}  // namespace kiln
