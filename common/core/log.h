#pragma once

#include <functional>
#include <memory>
#include <string>

#include <fmt/core.h>

#include "common/core/stamp.h"

namespace spdlog {
class logger;
}

namespace kiln {

/// In the order and with the numbers of the wire's log lines.
enum class LogLevel : std::uint8_t { Trace, Debug, Info, Warning, Error };

/// Level Error means that an operator must act.
///
/// A line is one line of printable characters, whatever it quotes. It goes to standard error by a
/// thread of its own (LineWriter): no loop waits for a terminal or a pipe, what is lost is counted
/// and said. Thread-safe.
///
/// Over spdlog, but formatted in one place: its own templates cost each file that logs four seconds
/// of the compiler's time.
class Logger {
 public:
  explicit Logger(std::shared_ptr<spdlog::logger> out) : out_(std::move(out)) {}
  template <class... Args>
  void debug(fmt::format_string<Args...> format, Args&&... args) const {
    write(LogLevel::Debug, format, fmt::make_format_args(args...));
  }
  template <class... Args>
  void info(fmt::format_string<Args...> format, Args&&... args) const {
    write(LogLevel::Info, format, fmt::make_format_args(args...));
  }
  template <class... Args>
  void warn(fmt::format_string<Args...> format, Args&&... args) const {
    write(LogLevel::Warning, format, fmt::make_format_args(args...));
  }
  template <class... Args>
  void error(fmt::format_string<Args...> format, Args&&... args) const {
    write(LogLevel::Error, format, fmt::make_format_args(args...));
  }
  void write(LogLevel level, fmt::string_view format, fmt::format_args args) const;

 private:
  friend void setLogLevel(int level);
  std::shared_ptr<spdlog::logger> out_;
};

/// The named logger of one module, e.g. logger("control.base"). Created on first use, lives as long
/// as the process. Thread-safe.
[[nodiscard]] const Logger* logger(const std::string& name);

struct LogRecord {
  std::string logger;
  int level = 2;  ///< LogLevel
  std::string text;
};

/// Takes its sink out again when it dies.
using LogSinkHandle = std::shared_ptr<void>;

/// Adds a sink that every logger writes to (the station's event log) for as long as the handle
/// lives. The callback runs on the logging thread, must be quick and must not log.
[[nodiscard]] LogSinkHandle addLogSink(std::function<void(const LogRecord&)> sink);

/// Waits until standard error has taken what was logged. @return false if it did not within
/// `limit`. Happens by itself, for at most half a second, when the process ends.
bool flushLog(Duration limit);

/// 0 trace, 1 debug, 2 info, 3 warning, 4 error. Applies to present and future loggers.
void setLogLevel(int level);

}  // namespace kiln
