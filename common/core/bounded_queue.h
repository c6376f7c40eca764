#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/mutex.h"

namespace kiln {

enum class DropPolicy { Oldest, Newest };

/// A queue with a limit and a stated policy for what happens at it. Thread-safe. Every drop is
/// counted.
template <class T>
class BoundedQueue {
 public:
  BoundedQueue(std::size_t capacity, DropPolicy policy) : capacity_(capacity), policy_(policy) {}

  /// @return false if a value (this one or an older one) was dropped.
  bool push(T value) {
    const std::lock_guard lock(mutex_);
    if (values_.size() < capacity_) {
      values_.push_back(std::move(value));
      return true;
    }
    ++dropped_;
    if (policy_ == DropPolicy::Oldest) {
      values_.pop_front();
      values_.push_back(std::move(value));
    }
    return false;
  }
  [[nodiscard]] std::optional<T> pop() {
    const std::lock_guard lock(mutex_);
    if (values_.empty()) return std::nullopt;
    T value = std::move(values_.front());
    values_.pop_front();
    return value;
  }
  [[nodiscard]] std::vector<T> drain() {
    const std::lock_guard lock(mutex_);
    std::vector<T> out(std::make_move_iterator(values_.begin()),
                       std::make_move_iterator(values_.end()));
    values_.clear();
    return out;
  }
  [[nodiscard]] std::uint64_t dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }
  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return values_.size();
  }

 private:
  mutable Mutex mutex_;
  std::deque<T> values_;
  std::size_t capacity_;
  DropPolicy policy_;
  std::uint64_t dropped_ = 0;
};

}  // namespace kiln
