#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "common/core/stamp.h"

namespace kiln {

/// Hands a finished job's result to its consumer. Runs on the job's thread (ThreadExecutor) or,
/// under the manual clock, at post time + modelled latency; so it may only write to thread-safe
/// slots (LatestValue, BoundedQueue).
using Delivery = std::function<void()>;

/// A unit of perception or planning work.
struct Job {
  std::string kind;             ///< e.g. "heat_detection"; named in statistics
  Duration modelled_latency{};  ///< lockstep: result arrives this long after post
  std::function<Delivery(std::stop_token)>
      run;  ///< pure work; returns how to deliver (may be empty)
};

/// Rates and slips of one periodic tick.
struct TickStatistics {
  std::string name;
  std::uint64_t ticks = 0;
  std::uint64_t slips = 0;  ///< periods that were missed altogether
  double worst_late_s = 0.0;
};

/// Where ticks and jobs run. Same code under both forms: ThreadExecutor (a thread a tick, a pool
/// for jobs) and ManualExecutor (everything on one thread under a ManualClock, in the order (time,
/// priority, sequence)).
class Executor {
 public:
  virtual ~Executor() = default;
  /// Queues a job. At most one job of a kind is in flight, waiting or running, so that a kind may
  /// keep state of its own; while one is, a new one is refused: returns false and counts a drop.
  /// The next sample comes soon enough.
  virtual bool post(Job job) = 0;
  /// Calls `tick(now)` each period, first at now + period. Lower priority numbers run first at
  /// equal times. To be called before start() of a ThreadExecutor or before the first run of a
  /// ManualExecutor.
  virtual void every(Duration period, std::string name, int priority,
                     std::function<void(Stamp)> tick) = 0;
  [[nodiscard]] virtual std::vector<TickStatistics> statistics() const = 0;
  [[nodiscard]] virtual std::uint64_t droppedJobs() const = 0;
};

/// Priorities of the rate groups: what runs first when two fall on the same instant.
inline constexpr int kPriorityDelivery = 0;  ///< results of jobs
inline constexpr int kPriorityMission = 10;
inline constexpr int kPriorityControl = 20;
inline constexpr int kPriorityTelemetry = 30;

}  // namespace kiln
