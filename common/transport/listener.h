#pragma once

#include <cstddef>
#include <string>

#include "common/core/error.h"

namespace kiln {

/// A file descriptor that closes itself.
class UniqueFd {
 public:
  explicit UniqueFd(int fd = -1) : fd_(fd) {}
  UniqueFd(UniqueFd&& other) noexcept;
  UniqueFd& operator=(UniqueFd&& other) noexcept;
  ~UniqueFd() { reset(); }
  void reset(int fd = -1);
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

struct Accepted {
  UniqueFd fd;
  int process = 0;      ///< at the other end of ipc; 0 for tcp
  std::string address;  ///< of tcp
  /// For the log.
  [[nodiscard]] std::string name() const;
};

/// A listening stream socket, tcp or ipc, that does not block. One descriptor is kept in reserve,
/// so that it can turn callers away when the process has no other left.
class Listener {
 public:
  /// Error Unavailable: in use, or not possible, in one sentence.
  [[nodiscard]] static Result<Listener> bind(const std::string& address);
  Listener(Listener&&) = default;
  Listener& operator=(Listener&&) = delete;
  ~Listener();

  [[nodiscard]] int fd() const { return fd_.get(); }
  /// The next caller; its fd is -1 when nobody waits or the process has no descriptor for him.
  [[nodiscard]] Accepted accept();
  /// Closes the connection of the next caller.
  void turnAway();

 private:
  Listener(UniqueFd fd, std::string path);
  UniqueFd fd_, reserve_;
  std::string path_;  ///< of ipc: removed at the end
};

/// How many of `wanted` descriptors one of a few sockets may take: an eighth of what the process
/// may have open.
[[nodiscard]] std::size_t affordableDescriptors(std::size_t wanted);

}  // namespace kiln
