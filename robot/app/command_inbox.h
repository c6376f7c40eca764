#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "common/transport/zmtp_server.h"
#include "robot/safety/operator_peer.h"

namespace kiln {

/// Commands on their way to the mission tick: as many of each client as its own share holds, so
/// that nobody's flood costs another's command. Thread-compatible.
class CommandInbox {
 public:
  explicit CommandInbox(std::size_t share) : share_(share) {}

  /// @return false, and the command is dropped, when this client's share is full.
  [[nodiscard]] bool push(PeerId from, ReceivedCommand command) {
    if (std::size_t& waiting = waiting_[from]; waiting < share_) {
      ++waiting;
      commands_.push_back(std::move(command));
      return true;
    }
    ++dropped_;
    return false;
  }
  /// All, in the order of their arrival.
  [[nodiscard]] std::vector<ReceivedCommand> drain() {
    waiting_.clear();
    return std::exchange(commands_, {});
  }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  std::size_t share_;
  std::vector<ReceivedCommand> commands_;
  std::map<PeerId, std::size_t> waiting_;
  std::uint64_t dropped_ = 0;
};

}  // namespace kiln
