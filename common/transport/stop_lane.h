#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "common/core/error.h"

namespace kiln {

/// The robot's end of the STOP lane: a socket and thread of its own, so that nothing else that goes
/// wrong on the link can delay it. `on_request` runs on that thread and returns the answer; empty =
/// none. A message that breaks the protocol is a request too, one that nobody can read.
class StopServer {
 public:
  using Handler = std::function<std::string(std::string_view request)>;
  [[nodiscard]] static Result<std::unique_ptr<StopServer>> bind(const std::string& address,
                                                                Handler on_request);
  ~StopServer();

 private:
  struct Impl;
  explicit StopServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// A station's end: repeats the newest request at 20 Hz until an answer is accepted. Own context,
/// socket and thread.
class StopClient {
 public:
  struct Handlers {
    /// @return true when the answer settles the request.
    std::function<bool(std::string_view answer)> on_answer;
    std::function<void()> on_sent;  ///< each repetition that left
  };
  [[nodiscard]] static Result<std::unique_ptr<StopClient>> connect(const std::string& address,
                                                                   Handlers handlers);
  ~StopClient();
  /// Thread-safe. Replaces a request that is still being repeated.
  void request(std::string message);

 private:
  struct Impl;
  explicit StopClient(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
