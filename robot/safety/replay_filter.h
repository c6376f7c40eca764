#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "common/core/stamp.h"

namespace kiln {

/// Remembers the nonces of each client, so that a repeated or re-ordered command is known as one.
/// Nonces of one client grow: a window of the last 64 below the highest is kept one by one (as in
/// RFC 4303, 3.4.3), older ones count as seen. One that lies too far ahead to have been counted to
/// is refused and changes nothing, so that no single command can end a client's numbers. A client
/// is kept for as long as any command of it could still be young enough to be obeyed; when too many
/// are kept, new ones wait. Confined to the mission thread.
class ReplayFilter {
 public:
  enum class Verdict { Fresh, Replayed, OutOfOrder, Implausible, TooMany };

  /// @param setpoint  a setpoint older than one already seen is OutOfOrder: the newest wins.
  ///                  Discrete commands may overtake each other within the window.
  [[nodiscard]] Verdict check(const std::string& client_id, std::uint64_t nonce, bool setpoint,
                              Stamp now);

 private:
  struct Client {
    std::uint64_t highest = 0;
    std::uint64_t seen = 0;  ///< bit i: highest - i
    std::uint64_t highest_setpoint = 0;
    Stamp last;
  };
  /// @return false if every client is still needed.
  bool forgetTheSilent(Stamp now);

  std::unordered_map<std::string, Client> clients_;
};

}  // namespace kiln
