#pragma once

#include <mutex>
#include <string>
#include <string_view>

#include "common/core/clock.h"
#include "common/core/mutex.h"

namespace kiln {

/// Notices that a method of a state has not returned. The mission thread marks begin and end; any
/// thread may ask. Thread-safe.
class Watchdog {
 public:
  Watchdog(const Clock& clock, Duration limit) : clock_(clock), limit_(limit) {}

  /// Marks one call for as long as the object lives.
  class Call {
   public:
    Call(Watchdog& watchdog, std::string_view state, std::string_view method);
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    Watchdog& watchdog_;
  };

  /// "AimHose::execute has not returned for 1.2 s" once the limit is passed, else empty.
  [[nodiscard]] std::string blocked() const;

 private:
  const Clock& clock_;
  const Duration limit_;
  mutable Mutex mutex_;
  std::string_view state_;  ///< static storage; empty = no call is under way
  std::string_view method_;
  Stamp since_;
};

}  // namespace kiln
