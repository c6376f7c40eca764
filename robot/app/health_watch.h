#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "common/core/mutex.h"
#include "common/model/status.h"

namespace kiln {

/// Tells the stations that the mission thread stands in a state, which that thread cannot: sends
/// the last status again with the alarm "fsm.blocked". tick() belongs on a thread of its own; the
/// rest may be called from any thread.
class HealthWatch {
 public:
  /// @param blocked  "AimHose::execute has not returned for 1.2 s", or empty; from any thread.
  /// @param publish  from any thread.
  HealthWatch(std::function<std::string()> blocked, std::function<void(RobotStatus)> publish)
      : blocked_(std::move(blocked)), publish_(std::move(publish)) {}

  /// The status that was published last.
  void remember(const RobotStatus& status);
  void tick(Stamp now);
  /// What blocked since this was asked last; empty: nothing did.
  [[nodiscard]] std::string take();

 private:
  std::function<std::string()> blocked_;
  std::function<void(RobotStatus)> publish_;
  Mutex mutex_;
  RobotStatus last_;
  std::string text_;
  bool told_ = false;  ///< in the log; tick() only
};

}  // namespace kiln
