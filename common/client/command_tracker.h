#pragma once

#include <map>
#include <vector>

#include "common/client/command_update.h"
#include "common/model/command.h"
#include "common/transport/monotonic.h"

namespace kiln {

[[nodiscard]] CommandState stateOf(AckOutcome outcome);

/// Follows each discrete command from sending to its end. No answer within the time-out makes it
/// UNKNOWN, which is not a failure; a late answer still counts. Nothing is ever sent again from
/// here. Thread-compatible.
class CommandTracker {
 public:
  explicit CommandTracker(double timeout_s) : timeout_s_(timeout_s) {}

  [[nodiscard]] CommandUpdate sent(std::uint64_t nonce, const CommandBody& body,
                                   Monotonic::time_point now);
  /// @return the new state; refusals of setpoints, which are not followed, come out too.
  [[nodiscard]] CommandUpdate answered(const CommandAck& ack, Monotonic::time_point now);
  /// Commands that have just become UNKNOWN.
  [[nodiscard]] std::vector<CommandUpdate> expire(Monotonic::time_point now);

 private:
  struct Pending {
    CommandUpdate update;
    Monotonic::time_point sent;
  };
  double timeout_s_;
  std::map<std::uint64_t, Pending> pending_;  ///< bounded: the oldest is forgotten
};

}  // namespace kiln
