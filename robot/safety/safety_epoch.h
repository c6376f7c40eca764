#pragma once

#include <atomic>
#include <cstdint>

namespace kiln {

/// Counts what invalidates queued and multi-step work: a STOP, a lost link, a change of the lease.
/// Work remembers the value at its start and ends itself when it has moved on; checked between
/// every macro step. Thread-safe.
class SafetyEpoch {
 public:
  void bump() { value_.fetch_add(1); }
  [[nodiscard]] std::uint64_t value() const { return value_.load(); }

 private:
  std::atomic<std::uint64_t> value_{1};
};

}  // namespace kiln
