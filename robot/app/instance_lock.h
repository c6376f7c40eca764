#pragma once

#include <string>

#include "common/core/error.h"

namespace kiln {

/// Held for the life of the process: two daemons on one robot would fight over its devices. The
/// kernel releases it however the process ends.
class InstanceLock {
 public:
  /// Creates `folder` if need be. Error: Refused if another process holds it (names its process
  /// id); Storage if the folder cannot be written.
  [[nodiscard]] static Result<InstanceLock> acquire(const std::string& folder);
  InstanceLock(InstanceLock&& other) noexcept;
  InstanceLock& operator=(InstanceLock&&) = delete;
  ~InstanceLock();

 private:
  explicit InstanceLock(int fd) : fd_(fd) {}
  int fd_;
};

}  // namespace kiln
