#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "common/core/stamp.h"

namespace kiln {

/// Remembers the nonces of each client, so that a repeated or re-ordered command is known as one.
/// Nonces of one client grow; the last 64 are kept one by one, older ones count as seen. Bounded in
/// clients: the one that was silent longest is forgotten (its lease epoch is over by then).
/// Confined to the mission thread.
class ReplayFilter {
 public:
  enum class Verdict { Fresh, Replayed, OutOfOrder };

  /// @param setpoint  a setpoint older than one already seen is OutOfOrder: the newest wins.
  /// Discrete commands may
  ///                  overtake each other within the window.
  [[nodiscard]] Verdict check(const std::string& client_id, std::uint64_t nonce, bool setpoint,
                              Stamp now);

 private:
  struct Client {
    std::deque<std::uint64_t> recent;
    std::uint64_t highest = 0;
    std::uint64_t highest_setpoint = 0;
    Stamp last;
  };
  void forgetOldest();

  std::map<std::string, Client> clients_;
};

}  // namespace kiln
