#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

#include "common/core/mutex.h"

namespace kiln {

/// A mailbox for one value: the newest wins, the reader never blocks the writer for longer than a
/// copy. Thread-safe. Overwritten unread values are counted (drop policy: oldest).
template <class T>
class LatestValue {
 public:
  void put(T value) {
    const std::lock_guard lock(mutex_);
    if (fresh_) ++overwritten_;
    value_ = std::move(value);
    fresh_ = true;
  }
  /// The newest value whether or not it was read before.
  [[nodiscard]] std::optional<T> peek() const {
    const std::lock_guard lock(mutex_);
    return value_;
  }
  /// The newest value if it was not taken yet.
  [[nodiscard]] std::optional<T> takeFresh() {
    const std::lock_guard lock(mutex_);
    if (!fresh_) return std::nullopt;
    fresh_ = false;
    return value_;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    value_.reset();
    fresh_ = false;
  }
  [[nodiscard]] std::uint64_t overwritten() const {
    const std::lock_guard lock(mutex_);
    return overwritten_;
  }

 private:
  mutable Mutex mutex_;
  std::optional<T> value_;
  bool fresh_ = false;
  std::uint64_t overwritten_ = 0;
};

}  // namespace kiln
