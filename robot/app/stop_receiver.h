#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>

#include "common/core/clock.h"
#include "common/core/error.h"
#include "common/transport/log_throttle.h"
#include "robot/safety/stop_latch.h"

namespace kiln {

class StopServer;

/// The robot's half of the STOP lane: sets the latch the moment a request arrives, on a thread,
/// and socket of its own. Asks for no lease and no hello. Whatever arrives here
/// means stop, readable or not.
///
/// Confined to the lane's thread.
class StopReceiver {
 public:
  /// `clock` and `latch` must outlive the receiver.
  /// Error: Unavailable when the port or path is in use.
  [[nodiscard]] static Result<std::unique_ptr<StopReceiver>> bind(const std::string& address,
                                                                  const Clock& clock,
                                                                  StopLatch& latch);
  ~StopReceiver();
  StopReceiver(const StopReceiver&) = delete;
  StopReceiver& operator=(const StopReceiver&) = delete;

 private:
  /// A STOP that was obeyed: its repetitions are answered, not obeyed again after somebody has
  /// cleared the latch.
  struct Handled {
    std::string client_id;
    std::uint64_t nonce = 0;
    Stamp latched;
  };
  StopReceiver(const Clock& clock, StopLatch& latch);
  [[nodiscard]] std::string onRequest(std::string_view bytes);

  const Clock& clock_;
  StopLatch& latch_;
  std::deque<Handled> handled_;
  LogThrottle log_{"link"};
  std::unique_ptr<StopServer> server_;  // last: its thread calls all of the above
};

}  // namespace kiln
