#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "common/model/command.h"
#include "common/model/status.h"

namespace kiln {

/// First message of a client to a robot; answered by HelloReply (status.h).
struct Hello {
  std::uint32_t protocol = kProtocolVersion;
  std::string version;    ///< of the client program
  std::string client_id;  ///< random per process
  std::string operator_name;
  ClientRole role = ClientRole::Operator;
  std::string expected_mission_uuid;  ///< empty: whatever the robot runs
  /// Random per process and never published: shows that a client that comes back on a new
  /// connection is the same. 0: it cannot show that.
  std::uint64_t key = 0;
};

/// 5 Hz each way; carries how well the sender hears the other side, and the clock exchange.
struct Heartbeat {
  std::uint64_t seq = 0;
  std::int64_t station_send_ns = 0;   ///< t0, station clock; 0 in a heartbeat that answers nothing
  std::int64_t robot_receive_ns = 0;  ///< t1, robot clock; reply only
  std::int64_t robot_send_ns = 0;     ///< t2, robot clock; from the robot only
  double rx_age_s = 0.0;  ///< age of the newest message from the other side, as the sender sees it
  double rtt_s = 0.0;     ///< sender's last estimate; 0 = none yet
  std::int64_t robot_estimate_ns = 0;  ///< station_send_ns by the robot's clock, as the station
                                       ///< believes; 0 = no estimate yet
};

/// The STOP lane: a socket and thread of its own, no lease, from anybody. Repeated at 20 Hz until
/// acknowledged.
struct StopRequest {
  std::string client_id;
  std::string operator_name;
  std::uint64_t nonce = 0;  ///< the same for each repetition of one press
  std::int64_t sent_station_ns = 0;
};
struct StopAck {
  std::uint64_t nonce = 0;
  std::int64_t sent_station_ns = 0;  ///< echoed
  std::int64_t latched_robot_ns = 0;
  bool latched = false;
};

/// What the command socket carries, either way.
using ToRobot = std::variant<Hello, Heartbeat, Command>;
using ToStation = std::variant<HelloReply, Heartbeat, CommandAck>;

}  // namespace kiln
