#include "robot/app/operator_peers.h"

#include <algorithm>
#include <cmath>

#include "common/core/error.h"

namespace kiln {
namespace {

constexpr double kHeartbeatPeriod_s = 0.2;
constexpr std::size_t kMaxPeers = 32;
constexpr std::size_t kMaxLeft = 4096;
constexpr double kSilent_s = 2.0;          // ten heartbeats
constexpr double kKeptWithoutKey_s = 3.0;  // longer than a lease lives unheard (2 s)
constexpr std::size_t kClockSamples = 8;

/// How far outside the round trip a heartbeat has spent by the station's own estimate of our clock.
double clockError(const Heartbeat& heartbeat, Stamp received) {
  const double under_way_s =
      toSeconds(received - stampFromNanoseconds(heartbeat.robot_estimate_ns));
  return under_way_s - std::clamp(under_way_s, 0.0, heartbeat.rtt_s);
}

}  // namespace

OperatorPeers::OperatorPeers(std::string robot_name, std::string version, double forget_after_s)
    : robot_name_(std::move(robot_name)),
      version_(std::move(version)),
      forget_after_s_(forget_after_s) {}

double OperatorPeers::keptFor_s(const Left& left) const {
  return left.key != 0 ? forget_after_s_ : kKeptWithoutKey_s;
}

std::string OperatorPeers::objectionToId(const Hello& hello) const {
  if (hello.client_id.empty()) return "the client has no id; restart the client";
  const auto left = left_.find(hello.client_id);
  const auto other = std::find_if(peers_.begin(), peers_.end(), [&](const auto& row) {
    return row.second.seen.client_id == hello.client_id;
  });
  const bool connected = other != peers_.end();
  if (!connected && left == left_.end())
    return left_.size() < kMaxLeft ? "" : "too many clients come and go; try again in some seconds";
  const std::uint64_t key = connected ? other->second.key : left->second.key;
  if (key != 0 && key == hello.key) return {};
  return "another connection has this client id; restart the client";
}

std::string OperatorPeers::objection(PeerId from, const Hello& hello,
                                     const std::string& mission_uuid) const {
  if (hello.protocol != kProtocolVersion) {
    return fmt::format(
        "{} runs Kiln {} (protocol {}), this client {} (protocol {}); install the same version at "
        "both ends",
        robot_name_, version_, kProtocolVersion, hello.version, hello.protocol);
  }
  if (!hello.expected_mission_uuid.empty() && hello.expected_mission_uuid != mission_uuid) {
    return fmt::format(
        "{} runs mission {}, this client expects {}; reconnect to the present mission", robot_name_,
        mission_uuid.empty() ? "none" : mission_uuid, hello.expected_mission_uuid);
  }
  if (const auto known = peers_.find(from); known != peers_.end()) {
    const OperatorPeer& first = known->second.seen;
    if (hello.client_id == first.client_id && hello.role == first.role) return {};
    return "this connection has said hello as somebody else; a second hello changes neither id nor "
           "role: connect anew";
  }
  return objectionToId(hello);
}

bool OperatorPeers::makeRoom(Monotonic::time_point now) {
  if (peers_.size() < kMaxPeers) return true;
  const auto silent = std::min_element(
      peers_.begin(), peers_.end(),
      [](const auto& a, const auto& b) { return a.second.heard < b.second.heard; });
  if (secondsBetween(silent->second.heard, now) < kSilent_s) return false;
  released_.push_back(silent->first);
  closed(silent->first, now);
  return true;
}

std::string OperatorPeers::hello(PeerId from, const Hello& hello, const std::string& mission_uuid,
                                 Stamp now, Monotonic::time_point heard) {
  if (std::string why = objection(from, hello, mission_uuid); !why.empty()) return why;
  if (!contains(from)) {
    if (const auto former = connectionOf(hello.client_id)) {  // its own
      released_.push_back(*former);
      peers_.erase(*former);
    }
    if (!makeRoom(heard))
      return fmt::format("{} clients are connected already; close one", kMaxPeers);
    left_.erase(hello.client_id);
    Peer& peer = peers_[from];
    peer.seen.client_id = hello.client_id;
    peer.seen.name = hello.operator_name;
    peer.seen.version = hello.version;
    peer.seen.role = hello.role;
    peer.key = hello.key;
  }
  (void)this->heard(from, now, heard);
  return {};
}

const OperatorPeer* OperatorPeers::heard(PeerId from, Stamp now, Monotonic::time_point at) {
  const auto peer = peers_.find(from);
  if (peer == peers_.end()) return nullptr;
  peer->second.seen.last_heard = now;
  peer->second.heard = at;
  return &peer->second.seen;
}

Heartbeat OperatorPeers::heartbeat(PeerId from, const Heartbeat& heartbeat, Stamp received,
                                   Monotonic::time_point at) {
  Peer& peer = peers_.at(from);
  peer.seen.rtt_s = heartbeat.rtt_s;
  peer.seen.peer_rx_age_s = heartbeat.rx_age_s;
  if (heartbeat.robot_estimate_ns != 0) {
    peer.clock_errors_s.push_back(clockError(heartbeat, received));
    if (peer.clock_errors_s.size() > kClockSamples) peer.clock_errors_s.pop_front();
    peer.seen.clock_error_s =
        *std::min_element(peer.clock_errors_s.begin(), peer.clock_errors_s.end(),
                          [](double a, double b) { return std::abs(a) < std::abs(b); });
  }
  peer.heartbeat_sent = at;
  Heartbeat answer;
  answer.seq = ++peer.heartbeats;
  answer.rtt_s = peer.seen.rtt_s;
  answer.station_send_ns = heartbeat.station_send_ns;
  answer.robot_receive_ns = toNanoseconds(received);
  return answer;
}

void OperatorPeers::closed(PeerId peer, Monotonic::time_point at) {
  const auto row = peers_.find(peer);
  if (row == peers_.end()) return;
  left_[row->second.seen.client_id] = {row->second.key, at};
  peers_.erase(row);
}

OperatorPeers::Turn OperatorPeers::tick(Monotonic::time_point now) {
  Turn turn;
  turn.released = std::exchange(released_, {});
  std::erase_if(left_, [&](const auto& row) {
    return secondsBetween(row.second.at, now) > keptFor_s(row.second);
  });
  for (auto at = peers_.begin(); at != peers_.end();) {
    Peer& peer = at->second;
    const double rx_age_s = secondsBetween(peer.heard, now);
    if (rx_age_s > forget_after_s_) {
      turn.gone.push_back(peer.seen.name);
      turn.released.push_back(at->first);
      at = peers_.erase(at);
      continue;
    }
    if (secondsBetween(peer.heartbeat_sent, now) >= kHeartbeatPeriod_s) {
      peer.heartbeat_sent = now;
      // Unasked for: it reaches a station that we do not hear, and tells it so.
      turn.due.emplace_back(at->first,
                            Heartbeat{++peer.heartbeats, 0, 0, 0, rx_age_s, peer.seen.rtt_s});
    }
    ++at;
  }
  return turn;
}

std::optional<PeerId> OperatorPeers::connectionOf(const std::string& client_id) const {
  for (const auto& [id, peer] : peers_) {
    if (peer.seen.client_id == client_id) return id;
  }
  return std::nullopt;
}

std::vector<OperatorPeer> OperatorPeers::list(Monotonic::time_point now) const {
  std::vector<OperatorPeer> out;
  for (const auto& [id, peer] : peers_) {
    out.push_back(peer.seen);
    out.back().rx_age_s = secondsBetween(peer.heard, now);
  }
  return out;
}

}  // namespace kiln
