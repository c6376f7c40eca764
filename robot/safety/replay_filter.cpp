#include "robot/safety/replay_filter.h"

#include <algorithm>

namespace kiln {
namespace {
constexpr std::size_t kWindow = 64;
constexpr std::size_t kMaxClients = 64;
}  // namespace

ReplayFilter::Verdict ReplayFilter::check(const std::string& client_id, std::uint64_t nonce,
                                          bool setpoint, Stamp now) {
  if (!clients_.contains(client_id) && clients_.size() >= kMaxClients) forgetOldest();
  Client& client = clients_[client_id];
  client.last = now;
  const bool below_window =
      client.recent.size() >= kWindow && nonce <= client.recent.front() && nonce < client.highest;
  if (nonce == 0 || below_window ||
      std::find(client.recent.begin(), client.recent.end(), nonce) != client.recent.end()) {
    return Verdict::Replayed;
  }
  client.recent.push_back(nonce);
  if (client.recent.size() > kWindow) client.recent.pop_front();
  client.highest = std::max(client.highest, nonce);
  if (!setpoint) return Verdict::Fresh;
  if (nonce < client.highest_setpoint) return Verdict::OutOfOrder;
  client.highest_setpoint = nonce;
  return Verdict::Fresh;
}

void ReplayFilter::forgetOldest() {
  const auto oldest =
      std::min_element(clients_.begin(), clients_.end(),
                       [](const auto& a, const auto& b) { return a.second.last < b.second.last; });
  clients_.erase(oldest);
}

}  // namespace kiln
