#pragma once

#include <optional>
#include <string>

#include "common/model/command.h"

namespace kiln {

/// A command as it came in. `command.issued` and `received` are both robot time.
struct ReceivedCommand {
  Command command;
  Stamp received;
  ClientRole role = ClientRole::Operator;  ///< what the sender said in its hello
  double rtt_s = 0.0;                      ///< the sender's round trip, as it last reported it
};

/// A client that has said hello.
struct OperatorPeer {
  std::string client_id;
  std::string name;
  std::string version;
  ClientRole role = ClientRole::Operator;
  Stamp last_heard;            ///< any message of it on the command socket: renews its lease
  double rx_age_s = 0.0;       ///< age of last_heard, by the link's own clock
  double peer_rx_age_s = 0.0;  ///< how old our last message is as the peer sees it (a deaf station)
  double rtt_s = 0.0;          ///< 0 = not measured yet
  /// By how much the station's idea of the robot's clock is off, as far as the round trip lets us
  /// tell (within it: 0); > 0: its commands look older than they are. nullopt: no idea yet.
  std::optional<double> clock_error_s{};
};

}  // namespace kiln
