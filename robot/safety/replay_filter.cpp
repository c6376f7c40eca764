#include "robot/safety/replay_filter.h"

namespace kiln {
namespace {
constexpr std::uint64_t kWindow = 64;
constexpr std::uint64_t kMostAhead = std::uint64_t{1} << 32;  // years of setpoints lost in a row
constexpr std::uint64_t kMostAtFirst = std::uint64_t{1} << 62;
constexpr std::size_t kMaxClients = 8192;
constexpr Duration kKept = std::chrono::seconds(10);  // above every age limit of the command gate
}  // namespace

ReplayFilter::Verdict ReplayFilter::check(const std::string& client_id, std::uint64_t nonce,
                                          bool setpoint, Stamp now) {
  auto at = clients_.find(client_id);
  const std::uint64_t highest = at == clients_.end() ? 0 : at->second.highest;
  if (nonce > (at == clients_.end() ? kMostAtFirst : highest + kMostAhead))
    return Verdict::Implausible;
  if (nonce == 0) return Verdict::Replayed;
  if (at == clients_.end()) {
    if (clients_.size() >= kMaxClients && !forgetTheSilent(now)) return Verdict::TooMany;
    at = clients_.try_emplace(client_id).first;
  }
  Client& client = at->second;
  client.last = now;
  if (nonce > client.highest) {
    const std::uint64_t step = nonce - client.highest;
    client.seen = (step < kWindow ? client.seen << step : 0) | 1u;
    client.highest = nonce;
  } else {
    const std::uint64_t back = client.highest - nonce;
    const std::uint64_t bit = back < kWindow ? std::uint64_t{1} << back : 0;
    if (bit == 0 || (client.seen & bit) != 0) return Verdict::Replayed;
    client.seen |= bit;
  }
  if (!setpoint) return Verdict::Fresh;
  if (nonce < client.highest_setpoint) return Verdict::OutOfOrder;
  client.highest_setpoint = nonce;
  return Verdict::Fresh;
}

bool ReplayFilter::forgetTheSilent(Stamp now) {
  return std::erase_if(clients_, [now](const auto& row) { return now - row.second.last > kKept; }) >
         0;
}

}  // namespace kiln
