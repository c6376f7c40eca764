#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "common/core/mutex.h"
#include "common/core/stamp.h"

namespace kiln {

/// The latched software stop: set by anyone at any time, from any thread, without a lease; cleared
/// only by the command gate on the lease holder's word. Controllers read it at every tick: base and
/// arm decelerate to rest, pumps are cut. Magnets would keep their state: a dropped brick is the
/// greater hazard.
///
/// Every STOP has a generation, also one that finds the latch set. It is cleared by naming the
/// newest one, so that a STOP which was acknowledged cannot be erased by a clear that was on its
/// way when it came. Thread-safe.
class StopLatch {
 public:
  /// @return the generation of this STOP, from 1.
  std::uint64_t set(const std::string& source, Stamp now) {
    const std::lock_guard lock(mutex_);
    const std::uint64_t generation = generation_.fetch_add(1) + 1;
    if (latched_.exchange(true)) return generation;  // first out: the first cause stays
    source_ = source;
    since_ = now;
    return generation;
  }
  /// @return false, and the latch stays, if a STOP came that `seen` does not know.
  [[nodiscard]] bool clear(std::uint64_t seen) {
    const std::lock_guard lock(mutex_);
    if (seen != generation_.load()) return false;
    latched_.store(false);
    source_.clear();
    return true;
  }
  /// Of the newest STOP; 0: there was none yet.
  [[nodiscard]] std::uint64_t generation() const { return generation_.load(); }
  [[nodiscard]] bool latched() const { return latched_.load(); }
  [[nodiscard]] std::string source() const {
    const std::lock_guard lock(mutex_);
    return source_;
  }
  [[nodiscard]] Stamp since() const {
    const std::lock_guard lock(mutex_);
    return since_;
  }

 private:
  std::atomic<bool> latched_{false};
  std::atomic<std::uint64_t> generation_{0};
  mutable Mutex mutex_;
  std::string source_;
  Stamp since_;
};

}  // namespace kiln
