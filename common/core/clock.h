#pragma once

#include <atomic>
#include <string>

#include "common/core/stamp.h"

namespace kiln {

/// Source of robot time. Injected wherever time is needed; thread-safe.
class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual Stamp now() const = 0;
};

/// The machine's monotonic clock. Used with real hardware and for simulation in real time.
class SteadyClock final : public Clock {
 public:
  [[nodiscard]] Stamp now() const override;
};

/// A clock that moves only when told: lockstep, replay and tests.
class ManualClock final : public Clock {
 public:
  explicit ManualClock(Stamp start = Stamp{}) : now_ns_(toNanoseconds(start)) {}
  [[nodiscard]] Stamp now() const override { return stampFromNanoseconds(now_ns_.load()); }
  /// @pre t is not before now(): time never runs backwards.
  void advanceTo(Stamp t);
  void advanceBy(Duration d) { advanceTo(now() + d); }

 private:
  std::atomic<std::int64_t> now_ns_;
};

/// Wall-clock time, "2026-01-31T12:00:00Z", for file names and audit logs; never for control.
[[nodiscard]] std::string wallTimeIso8601();

}  // namespace kiln
