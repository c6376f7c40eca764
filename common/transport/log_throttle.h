#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "common/core/log.h"
#include "common/transport/monotonic.h"

namespace kiln {

/// What a peer can cause as often as it likes: a few lines, then one a second, and the next one
/// says how many were kept back. Confined to one thread.
class LogThrottle {
 public:
  /// @param at_once  lines that may come in a burst.
  explicit LogThrottle(std::string logger_name, double at_once = 2.0)
      : logger_name_(std::move(logger_name)), most_(at_once), left_(at_once) {}

  template <class... Args>
  void warn(fmt::format_string<Args...> format, Args&&... args) {
    write(LogLevel::Warning, format, std::forward<Args>(args)...);
  }
  template <class... Args>
  void error(fmt::format_string<Args...> format, Args&&... args) {
    write(LogLevel::Error, format, std::forward<Args>(args)...);
  }
  template <class... Args>
  void info(fmt::format_string<Args...> format, Args&&... args) {
    write(LogLevel::Info, format, std::forward<Args>(args)...);
  }

 private:
  template <class... Args>
  void write(LogLevel level, fmt::format_string<Args...> format, Args&&... args) {
    const auto now = monotonicNow();
    left_ = std::min(most_, left_ + secondsBetween(std::exchange(last_, now), now));
    if (left_ < 1.0) {
      ++kept_back_;
      return;
    }
    left_ -= 1.0;
    std::string text = fmt::vformat(format, fmt::make_format_args(args...));
    if (const auto more = std::exchange(kept_back_, 0); more > 0)
      text += " (and " + std::to_string(more) + " such lines before it)";
    logger(logger_name_)->write(level, "{}", fmt::make_format_args(text));
  }

  std::string logger_name_;
  double most_, left_;
  Monotonic::time_point last_ = monotonicNow();
  std::uint64_t kept_back_ = 0;
};

}  // namespace kiln
