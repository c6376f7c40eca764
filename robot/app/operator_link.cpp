#include "robot/app/operator_link.h"

#include <mutex>
#include <utility>

#include "common/core/log.h"
#include "common/core/mutex.h"
#include "common/geom/frames.h"
#include "common/transport/log_throttle.h"
#include "common/transport/monotonic.h"
#include "common/transport/robot_end.h"
#include "common/wire/command.h"
#include "common/wire/fsm.h"
#include "common/wire/localization.h"
#include "common/wire/mission.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"
#include "robot/app/command_inbox.h"
#include "robot/app/operator_peers.h"
#include "robot/app/stop_receiver.h"

namespace kiln {

void OperatorLink::Config::visit(ConfigArchive& a) {
  a.field("forget_after_s", forget_after_s, "s", 2.0, 600.0,
          "a silent client is dropped from the list");
  a.field("command_queue", command_queue, "", 16, 4096,
          "commands of one client that may wait for the mission tick");
  a.field("cloud_resolution_m", cloud_resolution_m, "m", 0.001, 0.05,
          "quantisation of published clouds");
}

struct OperatorLink::Impl {
  Impl(Config c, Identity i, const Clock& robot_clock)
      : config(std::move(c)),
        identity(std::move(i)),
        clock(robot_clock),
        opened(robot_clock.now()),
        commands(static_cast<std::size_t>(config.command_queue)),
        peers(config.robot_name, identity.version, config.forget_after_s) {}

  // link thread
  void onMessage(PeerId from, std::string_view bytes);
  void onHello(PeerId from, const Hello& hello);
  void onHeartbeat(PeerId from, const Heartbeat& heartbeat);
  void onCommand(PeerId from, Command command);
  void onClosed(PeerId peer);
  void onTick();
  [[nodiscard]] HelloReply replyTo(std::string objection);

  void publish(Topic topic, LinkTap::Encode encode) {
    if (tap.published) tap.published(topic, encode, clock.now());
    end->publish(topic, std::move(encode));
  }
  void reply(PeerId to, const ToStation& message) { end->send(to, wire::encode(message)); }

  Config config;
  Identity identity;  // mission_uuid guarded by mutex
  const Clock& clock;
  LinkTap tap;
  std::atomic<bool> keep_pictures{false};
  const Stamp opened;
  mutable Mutex mutex;
  CommandInbox commands;  // guarded by mutex
  OperatorPeers peers;    // guarded by mutex
  // What a peer may cause as often as it likes is said once a second. Link thread only.
  LogThrottle unreadable{"link"}, refused{"link"}, came{"link"}, went{"link"};
  std::unique_ptr<RobotEnd> end;  // after everything its thread uses
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
  impl->end->start(
      {[raw = impl.get()](PeerId from, std::string_view bytes) { raw->onMessage(from, bytes); },
       [raw = impl.get()](PeerId peer) { raw->onClosed(peer); },
       [raw = impl.get()] { raw->onTick(); }});
  logger("link")->info("listening on {}", impl->config.endpoint);
  return std::unique_ptr<OperatorLink>(new OperatorLink(std::move(impl)));
}

OperatorLink::OperatorLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
OperatorLink::~OperatorLink() = default;

// --- link thread

void OperatorLink::Impl::onMessage(PeerId from, std::string_view bytes) {
  auto message = wire::decodeToRobot(bytes);
  if (!message) return unreadable.warn("{}: {}", end->nameOf(from), message.error().message);
  if (const auto* hello = std::get_if<Hello>(&*message)) return onHello(from, *hello);
  const Stamp now = clock.now();
  {
    std::unique_lock lock(mutex);
    if (peers.heard(from, now, monotonicNow()) == nullptr) {
      lock.unlock();
      return reply(from, replyTo(fmt::format("{} does not know this client; say hello first",
                                             config.robot_name)));
    }
  }
  if (const auto* heartbeat = std::get_if<Heartbeat>(&*message))
    return onHeartbeat(from, *heartbeat);
  onCommand(from, std::move(std::get<Command>(*message)));
}

HelloReply OperatorLink::Impl::replyTo(std::string objection) {
  HelloReply answer;
  answer.accepted = objection.empty();
  answer.reason = std::move(objection);
  answer.robot_name = config.robot_name;
  answer.version = identity.version;
  answer.protocol = kProtocolVersion;
  answer.environment = identity.environment;
  const std::lock_guard lock(mutex);
  answer.mission_uuid = identity.mission_uuid;
  return answer;
}

void OperatorLink::Impl::onHello(PeerId from, const Hello& hello) {
  bool is_new = false;
  std::string objection;
  {
    const std::lock_guard lock(mutex);
    is_new = !peers.contains(from);
    objection = peers.hello(from, hello, identity.mission_uuid, clock.now(), monotonicNow());
  }
  if (!objection.empty()) {
    refused.warn("refused {} of {}: {}", hello.operator_name, end->nameOf(from), objection);
  } else if (is_new) {
    end->keep(from, true);
    came.info("{} connected (Kiln {})", hello.operator_name, hello.version);
  }
  reply(from, replyTo(std::move(objection)));
}

void OperatorLink::Impl::onHeartbeat(PeerId from, const Heartbeat& heartbeat) {
  Heartbeat answer;
  {
    const std::lock_guard lock(mutex);
    answer = peers.heartbeat(from, heartbeat, clock.now(), monotonicNow());
  }
  answer.robot_send_ns = toNanoseconds(clock.now());
  reply(from, answer);
}

void OperatorLink::Impl::onCommand(PeerId from, Command command) {
  const Stamp received = clock.now();
  CommandAck refusal;
  refusal.nonce = command.nonce;
  refusal.command = commandName(command.body);
  refusal.outcome = AckOutcome::Refused;
  {
    const std::lock_guard lock(mutex);
    const OperatorPeer seen = *peers.heard(from, received, monotonicNow());
    refusal.client_id = seen.client_id;
    command.operator_name = seen.name;  // as introduced, not as claimed
    if (command.client_id != seen.client_id) {
      refusal.code = "wrong_client";
      refusal.reason = "the command carries another client's id; restart the client";
    } else if (command.issued < opened) {
      refusal.code = "too_old";
      refusal.reason = "the command was given before this daemon started; give it again";
    } else if (commands.push(from, {std::move(command), received, seen.role, seen.rtt_s})) {
      return;
    } else {
      refusal.code = "busy";
      refusal.reason = fmt::format(
          "{} commands of this client wait already; the robot's mission loop does not keep up",
          config.command_queue);
    }
  }
  reply(from, refusal);
}

void OperatorLink::Impl::onClosed(PeerId peer) {
  const std::lock_guard lock(mutex);
  peers.closed(peer, monotonicNow());
}

void OperatorLink::Impl::onTick() {
  OperatorPeers::Turn turn;
  {
    const std::lock_guard lock(mutex);
    turn = peers.tick(monotonicNow());
  }
  for (const std::string& name : turn.gone)
    went.info("{} is gone: not heard for {:.0f} s", name, config.forget_after_s);
  for (const PeerId peer : turn.released) end->keep(peer, false);
  for (auto& [to, heartbeat] : turn.due) {
    heartbeat.robot_send_ns = toNanoseconds(clock.now());
    reply(to, heartbeat);
  }
}

// --- any thread

std::vector<ReceivedCommand> OperatorLink::takeCommands() {
  std::vector<ReceivedCommand> commands;
  {
    const std::lock_guard lock(impl_->mutex);
    commands = impl_->commands.drain();
  }
  if (impl_->tap.command) {
    for (const ReceivedCommand& received : commands)
      impl_->tap.command(received.command, received.received);
  }
  return commands;
}
void OperatorLink::acknowledge(const CommandAck& ack) {
  if (impl_->tap.ack) impl_->tap.ack(ack, impl_->clock.now());
  std::optional<PeerId> to;
  {
    const std::lock_guard lock(impl_->mutex);
    to = impl_->peers.connectionOf(ack.client_id);
  }
  if (to) impl_->reply(*to, ack);
}

std::vector<OperatorPeer> OperatorLink::operators() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->peers.list(monotonicNow());
}

void OperatorLink::setMissionUuid(const std::string& uuid) {
  const std::lock_guard lock(impl_->mutex);
  impl_->identity.mission_uuid = uuid;
}

void OperatorLink::setTap(LinkTap tap) { impl_->tap = std::move(tap); }
void OperatorLink::keepPictures(bool keep) { impl_->keep_pictures.store(keep); }

void OperatorLink::publish(Topic topic, LinkTap::Encode encode) {
  impl_->publish(topic, std::move(encode));
}
double OperatorLink::cloudResolution() const { return impl_->config.cloud_resolution_m; }

bool OperatorLink::wanted(const std::string& jpeg_frame) const {
  if (impl_->keep_pictures.load()) return true;
  return impl_->end->subscribed(jpeg_frame == frames::kOperatorCamera ? Topic::OperatorCamera
                                                                      : Topic::HeadCamera);
}

std::vector<DropCount> OperatorLink::drops() const {
  std::vector<DropCount> out;
  for (const TopicInfo& info : topicTable())
    out.push_back({std::string(info.name), impl_->end->dropped(info.topic)});
  {
    const std::lock_guard lock(impl_->mutex);
    out.push_back({"commands", impl_->commands.dropped()});
  }
  out.push_back({"acks", impl_->end->droppedSends()});
  return out;
}

}  // namespace kiln
