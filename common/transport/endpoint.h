#pragma once

#include <string>

#include "common/core/error.h"

namespace kiln {

/// The four sockets of one robot.
struct LinkAddresses {
  std::string command, status, streams, stop;
  std::string ipc_prefix;  ///< empty for tcp
};

/// `tcp://127.0.0.1:7300` (command, status, streams and stop on port +0 .. +3) or
/// `ipc:///dir/prefix` (sockets /dir/prefix.command and so on). Error Refused for any address that
/// is neither ipc nor loopback: messages are neither encrypted nor authenticated until keys exist.
[[nodiscard]] Result<LinkAddresses> parseEndpoint(const std::string& endpoint);

/// Keeps a second robot off an ipc prefix: ZeroMQ itself would silently take the path over.
/// Released with the process.
class IpcLock {
 public:
  [[nodiscard]] static Result<IpcLock> acquire(const std::string& prefix);
  IpcLock(IpcLock&& other) noexcept;
  IpcLock& operator=(IpcLock&& other) = delete;
  ~IpcLock();

 private:
  explicit IpcLock(int fd) : fd_(fd) {}
  int fd_;
};

}  // namespace kiln
