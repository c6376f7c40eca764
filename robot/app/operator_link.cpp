#include "robot/app/operator_link.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

#include "common/core/bounded_queue.h"
#include "common/core/log.h"
#include "common/core/mutex.h"
#include "common/geom/frames.h"
#include "common/transport/monotonic.h"
#include "common/transport/robot_end.h"
#include "common/wire/command.h"
#include "common/wire/fsm.h"
#include "common/wire/localization.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"
#include "robot/app/stop_receiver.h"

namespace kiln {
namespace {

constexpr double kHeartbeatPeriod_s = 0.2;
constexpr double kUnusableRtt_s = 1e3;  // what a peer that reports nonsense is taken for
constexpr std::size_t kMaxPeers = 32;

double saneDuration(double seconds) {
  return std::isfinite(seconds) && seconds >= 0.0 ? seconds : kUnusableRtt_s;
}

constexpr std::size_t kClockSamples = 8;

/// How far outside the round trip a heartbeat has spent by the station's own estimate of our clock.
double clockError(const Heartbeat& heartbeat, Stamp received) {
  const double under_way_s =
      toSeconds(received - stampFromNanoseconds(heartbeat.robot_estimate_ns));
  return under_way_s - std::clamp(under_way_s, 0.0, saneDuration(heartbeat.rtt_s));
}

struct Peer {
  OperatorPeer seen;
  std::deque<double> clock_errors_s;  ///< the best of the last ones counts: heartbeats get delayed
  Monotonic::time_point heard;
  Monotonic::time_point heartbeat_sent;
  std::uint64_t heartbeats = 0;
};

}  // namespace

void OperatorLink::Config::visit(ConfigArchive& a) {
  a.field("endpoint", endpoint, "tcp://127.0.0.1:PORT (four ports in a row) or ipc:///dir/prefix");
  a.field("robot_name", robot_name, "shown at the station");
  a.field("forget_after_s", forget_after_s, "s", 2.0, 600.0,
          "a silent client is dropped from the list");
  a.field("command_queue", command_queue, "", 16, 4096,
          "commands that may wait for the mission tick");
  a.field("cloud_resolution_m", cloud_resolution_m, "m", 0.001, 0.05,
          "quantisation of published clouds");
}

struct OperatorLink::Impl {
  Impl(Config c, Identity i, const Clock& robot_clock)
      : config(std::move(c)),
        identity(std::move(i)),
        clock(robot_clock),
        commands(static_cast<std::size_t>(config.command_queue), DropPolicy::Newest) {}

  // link thread
  void onMessage(const std::string& from, std::string_view bytes);
  void onHello(const std::string& from, const Hello& hello);
  void onHeartbeat(const std::string& from, const Heartbeat& heartbeat);
  void onCommand(const std::string& from, Command command);
  void onTick();
  [[nodiscard]] std::string objection(const std::string& from, const Hello& hello) const;
  [[nodiscard]] bool heard(const std::string& from, Stamp now, OperatorPeer* seen);

  void publish(Topic topic, LinkTap::Encode encode) {
    if (tap.published) tap.published(topic, encode, clock.now());
    end->publish(topic, std::move(encode));
  }
  void reply(const std::string& to, const ToStation& message) {
    end->send(to, wire::encode(message));
  }

  Config config;
  Identity identity;  // mission_uuid guarded by mutex
  const Clock& clock;
  LinkTap tap;
  std::atomic<bool> keep_pictures{false};
  BoundedQueue<ReceivedCommand> commands;
  mutable Mutex mutex;
  std::map<std::string, Peer> peers;  // guarded by mutex
  std::unique_ptr<RobotEnd> end;      // after everything its thread uses
  std::unique_ptr<StopReceiver> stop_receiver;
};

Result<std::unique_ptr<OperatorLink>> OperatorLink::open(Config config, Identity identity,
                                                         const Clock& clock, StopLatch& stop) {
  const auto addresses = parseEndpoint(config.endpoint);
  if (!addresses) return tl::make_unexpected(addresses.error());
  auto impl = std::make_unique<Impl>(std::move(config), std::move(identity), clock);
  auto end = RobotEnd::bind(*addresses, clock);
  if (!end) return tl::make_unexpected(end.error());
  impl->end = std::move(*end);
  auto receiver = StopReceiver::bind(addresses->stop, clock, stop);
  if (!receiver) return tl::make_unexpected(receiver.error());
  impl->stop_receiver = std::move(*receiver);
  impl->end->start({[raw = impl.get()](const std::string& from, std::string_view bytes) {
                      raw->onMessage(from, bytes);
                    },
                    [raw = impl.get()] { raw->onTick(); }});
  logger("link")->info("listening on {}", impl->config.endpoint);
  return std::unique_ptr<OperatorLink>(new OperatorLink(std::move(impl)));
}

OperatorLink::OperatorLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
OperatorLink::~OperatorLink() = default;

// --- link thread
// -----------------------------------------------------------------------------------------------------

void OperatorLink::Impl::onMessage(const std::string& from, std::string_view bytes) {
  auto message = wire::decodeToRobot(bytes);
  if (!message) {
    logger("link")->warn("{}", message.error().message);
    return;
  }
  if (const auto* hello = std::get_if<Hello>(&*message)) return onHello(from, *hello);
  if (const auto* heartbeat = std::get_if<Heartbeat>(&*message))
    return onHeartbeat(from, *heartbeat);
  onCommand(from, std::move(std::get<Command>(*message)));
}

std::string OperatorLink::Impl::objection(const std::string& from, const Hello& hello) const {
  if (hello.protocol != kProtocolVersion) {
    return fmt::format(
        "{} runs Kiln {} (protocol {}), this client {} (protocol {}); install the same version at "
        "both ends",
        config.robot_name, identity.version, kProtocolVersion, hello.version, hello.protocol);
  }
  if (hello.client_id.empty() || hello.client_id != from) {
    return "the client id is not the one of its socket; restart the client";
  }
  if (!hello.expected_mission_uuid.empty() &&
      hello.expected_mission_uuid != identity.mission_uuid) {
    return fmt::format(
        "{} runs mission {}, this client expects {}; reconnect to the present mission",
        config.robot_name, identity.mission_uuid.empty() ? "none" : identity.mission_uuid,
        hello.expected_mission_uuid);
  }
  if (!peers.contains(from) && peers.size() >= kMaxPeers) {
    return fmt::format("{} clients are connected already; close one", kMaxPeers);
  }
  return {};
}

void OperatorLink::Impl::onHello(const std::string& from, const Hello& hello) {
  HelloReply answer;
  bool is_new = false;
  {
    const std::lock_guard lock(mutex);
    answer.reason = objection(from, hello);
    answer.accepted = answer.reason.empty();
    answer.mission_uuid = identity.mission_uuid;
    if (answer.accepted) {
      is_new = !peers.contains(from);
      Peer& peer = peers[from];
      peer.seen.client_id = hello.client_id;
      peer.seen.name = hello.operator_name;
      peer.seen.version = hello.version;
      peer.seen.role = hello.role;
      peer.seen.last_heard = clock.now();
      peer.heard = monotonicNow();
    } else {
      peers.erase(from);
    }
  }
  answer.robot_name = config.robot_name;
  answer.version = identity.version;
  answer.protocol = kProtocolVersion;
  answer.environment = identity.environment;
  if (!answer.accepted) logger("link")->warn("refused {}: {}", hello.operator_name, answer.reason);
  if (is_new) logger("link")->info("{} connected (Kiln {})", hello.operator_name, hello.version);
  reply(from, answer);
}

bool OperatorLink::Impl::heard(const std::string& from, Stamp now, OperatorPeer* seen) {
  {
    const std::lock_guard lock(mutex);
    const auto peer = peers.find(from);
    if (peer != peers.end()) {
      peer->second.seen.last_heard = now;
      peer->second.heard = monotonicNow();
      *seen = peer->second.seen;
      return true;
    }
  }
  HelloReply unknown;
  unknown.reason = fmt::format("{} does not know this client; say hello first", config.robot_name);
  unknown.robot_name = config.robot_name;
  unknown.version = identity.version;
  unknown.protocol = kProtocolVersion;
  reply(from, unknown);
  return false;
}

void OperatorLink::Impl::onHeartbeat(const std::string& from, const Heartbeat& heartbeat) {
  const Stamp received = clock.now();
  OperatorPeer seen;
  if (!heard(from, received, &seen)) return;
  Heartbeat answer;
  {
    const std::lock_guard lock(mutex);
    Peer& peer = peers[from];
    peer.seen.rtt_s = saneDuration(heartbeat.rtt_s);
    peer.seen.peer_rx_age_s = saneDuration(heartbeat.rx_age_s);
    if (heartbeat.robot_estimate_ns != 0) {
      peer.clock_errors_s.push_back(clockError(heartbeat, received));
      if (peer.clock_errors_s.size() > kClockSamples) peer.clock_errors_s.pop_front();
      peer.seen.clock_error_s =
          *std::min_element(peer.clock_errors_s.begin(), peer.clock_errors_s.end(),
                            [](double a, double b) { return std::abs(a) < std::abs(b); });
    }
    peer.heartbeat_sent = monotonicNow();
    answer.seq = ++peer.heartbeats;
    answer.rtt_s = peer.seen.rtt_s;
  }
  answer.station_send_ns = heartbeat.station_send_ns;
  answer.robot_receive_ns = toNanoseconds(received);
  answer.robot_send_ns = toNanoseconds(clock.now());
  reply(from, answer);
}

void OperatorLink::Impl::onCommand(const std::string& from, Command command) {
  const Stamp received = clock.now();
  OperatorPeer seen;
  if (!heard(from, received, &seen)) return;
  CommandAck refusal;
  refusal.client_id = from;
  refusal.nonce = command.nonce;
  refusal.command = commandName(command.body);
  refusal.outcome = AckOutcome::Refused;
  if (command.client_id != from) {
    refusal.code = "wrong_client";
    refusal.reason = "the command carries another client's id; restart the client";
    return reply(from, refusal);
  }
  command.operator_name = seen.name;  // as introduced, not as claimed
  if (commands.push({std::move(command), received, seen.role, seen.rtt_s})) return;
  refusal.code = "busy";
  refusal.reason = fmt::format(
      "{} commands wait already; the robot's mission loop does not keep up", commands.size());
  reply(from, refusal);
}

void OperatorLink::Impl::onTick() {
  const auto now = monotonicNow();
  std::vector<std::pair<std::string, Heartbeat>> due;
  {
    const std::lock_guard lock(mutex);
    for (auto it = peers.begin(); it != peers.end();) {
      Peer& peer = it->second;
      const double rx_age_s = secondsBetween(peer.heard, now);
      if (rx_age_s > config.forget_after_s) {
        logger("link")->info("{} is gone: not heard for {:.0f} s", peer.seen.name, rx_age_s);
        it = peers.erase(it);
        continue;
      }
      if (secondsBetween(peer.heartbeat_sent, now) >= kHeartbeatPeriod_s) {
        peer.heartbeat_sent = now;
        // Unasked for: it reaches a station that we do not hear, and tells it so.
        due.emplace_back(it->first,
                         Heartbeat{++peer.heartbeats, 0, 0, 0, rx_age_s, peer.seen.rtt_s});
      }
      ++it;
    }
  }
  for (auto& [to, heartbeat] : due) {
    heartbeat.robot_send_ns = toNanoseconds(clock.now());
    reply(to, heartbeat);
  }
}

// --- any thread
// ------------------------------------------------------------------------------------------------------

std::vector<ReceivedCommand> OperatorLink::takeCommands() {
  auto commands = impl_->commands.drain();
  if (impl_->tap.command) {
    for (const ReceivedCommand& received : commands)
      impl_->tap.command(received.command, received.received);
  }
  return commands;
}
void OperatorLink::acknowledge(const CommandAck& ack) {
  if (impl_->tap.ack) impl_->tap.ack(ack, impl_->clock.now());
  impl_->reply(ack.client_id, ack);
}

std::vector<OperatorPeer> OperatorLink::operators() const {
  const auto now = monotonicNow();
  const std::lock_guard lock(impl_->mutex);
  std::vector<OperatorPeer> out;
  for (const auto& [id, peer] : impl_->peers) {
    out.push_back(peer.seen);
    out.back().rx_age_s = secondsBetween(peer.heard, now);
  }
  return out;
}

void OperatorLink::setMissionUuid(const std::string& uuid) {
  const std::lock_guard lock(impl_->mutex);
  impl_->identity.mission_uuid = uuid;
}

void OperatorLink::setTap(LinkTap tap) { impl_->tap = std::move(tap); }
void OperatorLink::keepPictures(bool keep) { impl_->keep_pictures.store(keep); }

void OperatorLink::publish(RobotStatus status) {
  impl_->publish(Topic::RobotStatus, [value = std::move(status)] { return wire::encode(value); });
}
void OperatorLink::publish(FsmInfo info) {
  impl_->publish(Topic::FsmInfo, [value = std::move(info)] { return wire::encode(value); });
}
void OperatorLink::publish(FsmStatus status) {
  impl_->publish(Topic::FsmStatus, [value = std::move(status)] { return wire::encode(value); });
}
void OperatorLink::publish(Scene scene) {
  impl_->publish(Topic::Scene, [value = std::move(scene)] { return wire::encode(value); });
}
void OperatorLink::publish(std::vector<MacroInfo> macros) {
  impl_->publish(Topic::Macros, [value = std::move(macros)] { return wire::encode(value); });
}
void OperatorLink::publish(LocalizationStatus status) {
  impl_->publish(Topic::Localization, [value = std::move(status)] { return wire::encode(value); });
}
void OperatorLink::publish(Trajectory trajectory) {
  impl_->publish(Topic::Trajectory,
                 [value = std::move(trajectory)] { return wire::encode(value); });
}
void OperatorLink::publish(std::shared_ptr<const MapLayer> layer) {
  impl_->publish(Topic::MapLayer, [value = std::move(layer)] { return wire::encode(*value); });
}
void OperatorLink::publish(LogBatch batch) {
  impl_->publish(Topic::Log, [value = std::move(batch)] { return wire::encode(value); });
}
void OperatorLink::publish(PointCloudPtr cloud) {
  impl_->publish(Topic::Cloud,
                 [value = std::move(cloud), resolution_m = impl_->config.cloud_resolution_m] {
                   return wire::encode(*value, resolution_m);
                 });
}
void OperatorLink::publish(ThermalImagePtr image) {
  impl_->publish(Topic::Thermal, [value = std::move(image)] { return wire::encode(*value); });
}
void OperatorLink::publish(HeatDetections detections) {
  impl_->publish(Topic::Heat, [value = std::move(detections)] { return wire::encode(value); });
}
void OperatorLink::publish(JpegImagePtr image) {
  const Topic topic =
      image->frame == frames::kOperatorCamera ? Topic::OperatorCamera : Topic::HeadCamera;
  impl_->publish(topic, [value = std::move(image)] { return wire::encode(*value); });
}

bool OperatorLink::wanted(const std::string& jpeg_frame) const {
  if (impl_->keep_pictures.load()) return true;
  return impl_->end->subscribed(jpeg_frame == frames::kOperatorCamera ? Topic::OperatorCamera
                                                                      : Topic::HeadCamera);
}

std::vector<DropCount> OperatorLink::drops() const {
  std::vector<DropCount> out;
  for (const TopicInfo& info : topicTable())
    out.push_back({std::string(info.name), impl_->end->dropped(info.topic)});
  out.push_back({"commands", impl_->commands.dropped()});
  out.push_back({"acks", impl_->end->droppedSends()});
  return out;
}

}  // namespace kiln
