#pragma once

#include <functional>
#include <memory>
#include <string>

#include <spdlog/logger.h>

#include "common/core/stamp.h"

namespace kiln {

/// The named logger of one module, e.g. logger("control.base"). Created on first use; thread-safe.
/// Level `error` means that an operator must act.
///
/// A line is one line of printable characters, whatever it quotes. It goes to standard error by a
/// thread of its own (LineWriter): no loop waits for a terminal or a pipe, what is lost is counted
/// and said.
[[nodiscard]] std::shared_ptr<spdlog::logger> logger(const std::string& name);

struct LogRecord {
  std::string logger;
  int level = 2;  ///< spdlog: 0 trace .. 4 error, 5 critical
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
