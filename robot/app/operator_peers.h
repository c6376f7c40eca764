#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/stamp.h"
#include "common/model/link.h"
#include "common/transport/monotonic.h"
#include "common/transport/zmtp_server.h"
#include "robot/safety/operator_peer.h"

namespace kiln {

/// Who has said hello on which connection, and who is who: a client is its connection. What it said
/// first stands, a later hello changes neither role nor name, and its id is nobody else's while it
/// is connected. When it comes back on a new connection it proves by the key of its first hello
/// that it is the same; without one its id is kept from others until its lease is over. Times are
/// the link's own clock. Thread-compatible.
class OperatorPeers {
 public:
  OperatorPeers(std::string robot_name, std::string version, double forget_after_s);

  /// @return why it is refused, in one sentence; empty: it is known now.
  [[nodiscard]] std::string hello(PeerId from, const Hello& hello, const std::string& mission_uuid,
                                  Stamp now, Monotonic::time_point heard);
  /// Any message of it. @return nullptr if it has not said hello.
  [[nodiscard]] const OperatorPeer* heard(PeerId from, Stamp now, Monotonic::time_point at);
  /// @return the answer to be completed with the times; `from` has been heard.
  [[nodiscard]] Heartbeat heartbeat(PeerId from, const Heartbeat& heartbeat, Stamp received,
                                    Monotonic::time_point at);
  void closed(PeerId peer, Monotonic::time_point at);

  struct Turn {
    std::vector<std::pair<PeerId, Heartbeat>> due;  ///< unasked heartbeats
    std::vector<std::string> gone;                  ///< names of those now forgotten
    std::vector<PeerId> released;                   ///< connections that are nobody's any more
  };
  [[nodiscard]] Turn tick(Monotonic::time_point now);

  [[nodiscard]] bool contains(PeerId peer) const { return peers_.contains(peer); }
  [[nodiscard]] std::optional<PeerId> connectionOf(const std::string& client_id) const;
  [[nodiscard]] std::vector<OperatorPeer> list(Monotonic::time_point now) const;

 private:
  struct Peer {
    OperatorPeer seen;
    std::uint64_t key = 0;
    std::deque<double> clock_errors_s;  ///< the best of the last counts: heartbeats get delayed
    Monotonic::time_point heard, heartbeat_sent;
    std::uint64_t heartbeats = 0;
  };
  /// One that has left: its id is kept for it.
  struct Left {
    std::uint64_t key = 0;
    Monotonic::time_point at;
  };
  [[nodiscard]] std::string objection(PeerId from, const Hello& hello,
                                      const std::string& mission_uuid) const;
  [[nodiscard]] std::string objectionToId(const Hello& hello) const;
  [[nodiscard]] double keptFor_s(const Left& left) const;
  /// In a full list the one that has been silent longest goes, if any is silent.
  [[nodiscard]] bool makeRoom(Monotonic::time_point now);

  std::string robot_name_, version_;
  double forget_after_s_;
  std::map<PeerId, Peer> peers_;
  std::map<std::string, Left> left_;  ///< by client id; bounded
  std::vector<PeerId> released_;
};

}  // namespace kiln
