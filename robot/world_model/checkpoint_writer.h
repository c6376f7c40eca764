#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/core/error.h"
#include "common/core/mutex.h"

namespace kiln {

/// Writes one file again and again on a thread of its own, the newest text only: a slow disk never
/// delays the mission tick (pumps are cut 200 ms after the last setpoint). What was handed over
/// last is written before the end of the writer. Thread-safe.
class CheckpointWriter {
 public:
  explicit CheckpointWriter(std::string path);
  ~CheckpointWriter();
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  /// A text that was not written yet is replaced; its wish to be durable is kept.
  /// @param durable  also fsync: survives a power cut, not only kill -9.
  void write(std::string text, bool durable);
  /// Error of the newest attempt, if it failed.
  [[nodiscard]] std::optional<Error> problem() const;
  /// Waits until everything handed over so far has been tried.
  void flush();

 private:
  struct Order {
    std::string text;
    bool durable;
  };
  void work(const std::stop_token& stop);

  const std::string path_;
  mutable Mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<Order> order_;
  bool busy_ = false;
  std::optional<Error> problem_;
  std::jthread thread_;  ///< last: joined before the rest is destroyed
};

}  // namespace kiln
