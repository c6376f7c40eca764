#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "common/core/clock.h"
#include "common/core/executor.h"

namespace kiln {

/// Runs every tick and job on the calling thread under a ManualClock: the base of lockstep
/// missions, replay and tests. Events are ordered by (time, priority, sequence), so the same inputs
/// give the same run, byte for byte. Thread-compatible; confined to the thread that calls
/// runUntil().
class ManualExecutor final : public Executor {
 public:
  explicit ManualExecutor(ManualClock& clock) : clock_(clock) {}

  /// The job's work runs at once, its delivery at now + modelled_latency. At most one job of a kind
  /// is in flight.
  bool post(Job job) override;
  void every(Duration period, std::string name, int priority,
             std::function<void(Stamp)> tick) override;
  /// One-shot event, for tests and scripted faults.
  void at(Stamp time, int priority, std::function<void()> event);

  /// Executes all events up to and including `until`, advancing the clock to each event and finally
  /// to `until`.
  void runUntil(Stamp until);
  /// Time of the earliest pending event, or Stamp::max() when nothing is pending.
  [[nodiscard]] Stamp nextEvent() const;
  [[nodiscard]] std::vector<TickStatistics> statistics() const override;
  [[nodiscard]] std::uint64_t droppedJobs() const override { return dropped_jobs_; }

 private:
  using Key = std::tuple<Stamp, int, std::uint64_t>;
  struct Periodic {
    Duration period;
    int priority;
    std::function<void(Stamp)> tick;
    TickStatistics statistics;
  };
  void schedulePeriodic(std::size_t index, Stamp time);

  ManualClock& clock_;
  std::map<Key, std::function<void()>> events_;
  std::vector<std::unique_ptr<Periodic>> periodics_;
  std::map<std::string, int> in_flight_;
  std::uint64_t sequence_ = 0;
  std::uint64_t dropped_jobs_ = 0;
  std::stop_source stop_;
};

}  // namespace kiln
