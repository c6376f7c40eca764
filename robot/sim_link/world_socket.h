#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "common/core/error.h"
#include "common/transport/wake_event.h"
#include "common/transport/zmq_socket.h"
#include "kiln/v1/device.pb.h"

namespace kiln {

/// The robot's end of the device socket: messages in and out, hello. Confined to one thread at a
/// time.
class WorldSocket {
 public:
  /// @param wake  ends receive() early, in real time; nullptr in lockstep.
  static Result<std::unique_ptr<WorldSocket>> open(const std::string& endpoint, WakeEvent* wake);

  /// Never blocks. @return false when the world is not there to take it.
  bool send(const v1::device::ToWorld& message);
  /// The next message, or nullopt when none came in that time (or it was woken).
  [[nodiscard]] std::optional<v1::device::ToRobot> receive(std::chrono::milliseconds wait);
  /// Whether the connection closed since the last call.
  [[nodiscard]] bool lost() { return socket_.lost(); }
  /// Says hello until the world answers. A busy robot is asked again for a while: its last daemon
  /// may just be dying.
  [[nodiscard]] Result<v1::device::HelloReply> hello(const v1::device::Hello& message,
                                                     double timeout_s);

 private:
  explicit WorldSocket(WakeEvent* wake);
  ZmqContext context_;
  ZmqSocket socket_;
  std::string endpoint_;
  WakeEvent* wake_;
};

}  // namespace kiln
