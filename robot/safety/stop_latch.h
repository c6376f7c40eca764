#pragma once

#include <atomic>
#include <mutex>
#include <string>

#include "common/core/mutex.h"
#include "common/core/stamp.h"

namespace kiln {

/// The latched software stop: set by anyone at any time, from any thread, without a lease; cleared
/// only by the command gate on the lease holder's word. Controllers read it at every tick: base and
/// arm decelerate to rest, pumps are cut. Magnets would keep their state: a dropped brick is the
/// greater hazard.
class StopLatch {
 public:
  void set(const std::string& source, Stamp now) {
    const std::lock_guard lock(mutex_);
    if (latched_.exchange(true)) return;  // first out: the first cause stays
    source_ = source;
    since_ = now;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    latched_.store(false);
    source_.clear();
  }
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
  mutable Mutex mutex_;
  std::string source_;
  Stamp since_;
};

}  // namespace kiln
