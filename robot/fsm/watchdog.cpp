#include "robot/fsm/watchdog.h"

#include <fmt/format.h>

namespace kiln {

Watchdog::Call::Call(Watchdog& watchdog, std::string_view state, std::string_view method)
    : watchdog_(watchdog) {
  const Stamp since = watchdog_.clock_.now();
  const std::lock_guard lock(watchdog_.mutex_);
  watchdog_.state_ = state;
  watchdog_.method_ = method;
  watchdog_.since_ = since;
}

Watchdog::Call::~Call() {
  const std::lock_guard lock(watchdog_.mutex_);
  watchdog_.state_ = {};
}

std::string Watchdog::blocked() const {
  const Stamp now = clock_.now();
  const std::lock_guard lock(mutex_);
  if (state_.empty() || now - since_ < limit_) return {};
  return fmt::format("{}::{} has not returned for {:.1f} s", state_, method_,
                     toSeconds(now - since_));
}

}  // namespace kiln
