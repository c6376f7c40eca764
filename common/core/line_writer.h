#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <thread>

#include "common/core/mutex.h"
#include "common/core/stamp.h"

namespace kiln {

/// Writes lines to a file descriptor on a thread of its own, so that a terminal held by Ctrl-S or a
/// pipe that nobody reads keeps nobody waiting. At most 1000 lines wait; then the oldest goes, and
/// the output says how many went before it. Thread-safe.
class LineWriter {
 public:
  explicit LineWriter(int fd);
  /// Drops what waits.
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  /// Never blocks on the descriptor. `line` ends in a line feed.
  void push(std::string line);
  /// @return false if something still waits after `limit`.
  bool flush(Duration limit);
  [[nodiscard]] std::uint64_t lost() const;

 private:
  void run(const std::stop_token& stop);
  [[nodiscard]] std::string next();
  void wake() const;

  const int fd_;
  // Not a condition variable: its inner mutex does not lend its priority, and control loops log.
  const int wake_fd_;
  mutable Mutex mutex_;
  std::deque<std::string> waiting_;
  bool writing_ = false;
  std::uint64_t lost_ = 0, lost_said_ = 0;
  std::jthread thread_;
};

/// Writes all of `bytes` unless the descriptor takes nothing until `stop` or for `limit`.
/// @return whether all of it went.
bool writeWithin(int fd, std::string_view bytes, Duration limit, const std::stop_token& stop = {});

}  // namespace kiln
