#pragma once

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "common/core/check.h"
#include "common/core/mutex.h"
#include "common/core/stamp.h"
#include "robot/control/writer.h"

namespace kiln {

/// The newest setpoint of one controller and the rules that all of them share: refused ones void
/// the one before, older stamps than the newest are dropped, too old or future ones mean stop. One
/// writer at a time: a second one may ask for motion when the first has asked for rest or was
/// silent for its ttl; anything else is our own bug. Thread-safe.
template <class Setpoint>
class SetpointSlot {
 public:
  struct Taken {
    std::optional<Setpoint> setpoint;  ///< nullopt: stop
    std::string blocked;               ///< why there is none
    bool refused = false;
    /// Whose motion it is; nullopt: nobody's.
    [[nodiscard]] std::optional<Writer> writer() const {
      return setpoint && !setpoint->rests() ? std::optional(setpoint->writer) : std::nullopt;
    }
  };

  void put(const Setpoint& setpoint) {
    const std::lock_guard lock(mutex_);
    if (newest_ && setpoint.stamp < newest_->stamp) return;  // re-ordered on the way
    KILN_CHECK(!newest_ || newest_->writer == setpoint.writer || newest_->rests() ||
                   setpoint.rests() || setpoint.stamp - newest_->stamp >= newest_->ttl,
               "an actuator has one writer at a time");
    newest_ = setpoint;
    refusal_.clear();
  }
  /// A bad setpoint stops what runs: whoever sent it is not to be trusted with the motion.
  void refuse(std::string reason) {
    const std::lock_guard lock(mutex_);
    newest_.reset();
    refusal_ = std::move(reason);
  }
  /// Forgets everything: after STOP or a protective stop nothing old may move the robot.
  void clear() {
    const std::lock_guard lock(mutex_);
    newest_.reset();
    refusal_.clear();
  }
  [[nodiscard]] Taken take(Stamp now, Duration max_age, Duration future_tolerance) const {
    const std::lock_guard lock(mutex_);
    if (!refusal_.empty()) return {std::nullopt, refusal_, true};
    if (!newest_) return {std::nullopt, "no setpoint", false};
    const Duration age = now - newest_->stamp;
    if (-age > future_tolerance) {
      return {std::nullopt,
              fmt::format("setpoint is {:.0f} ms in the future", -1e3 * toSeconds(age)), true};
    }
    if (age >= std::min(newest_->ttl, max_age)) {
      return {std::nullopt, fmt::format("setpoint is {:.0f} ms old", 1e3 * toSeconds(age)), false};
    }
    return {newest_, "", false};
  }

 private:
  mutable Mutex mutex_;
  std::optional<Setpoint> newest_;
  std::string refusal_;
};

}  // namespace kiln
