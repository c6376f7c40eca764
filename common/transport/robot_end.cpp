#include "common/transport/robot_end.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include <poll.h>

#include "common/core/bounded_queue.h"
#include "common/transport/subscriptions.h"
#include "common/transport/wake_event.h"

namespace kiln {
namespace {

constexpr double kTick_s = 0.05;
constexpr std::size_t kSendQueue = 1024;
constexpr std::size_t kMaxSubscription = 1 << 10;  // bytes

ZmtpServer::Limits publisherLimits(std::size_t max_queued, std::size_t max_queued_bytes) {
  ZmtpServer::Limits limits;
  limits.max_message_bytes = kMaxSubscription;
  limits.max_queued = max_queued;
  limits.max_queued_bytes = max_queued_bytes;
  return limits;
}

ZmtpMessage framed(const Outbox::Message& message) {
  return frameMessage(
      {topicInfo(message.topic).name, encodeFrameHeader(message.header), message.payload});
}

/// One publishing socket and what each of its subscribers wants.
struct Publisher {
  Lane lane;
  ZmtpServer::Limits limits;
  std::unique_ptr<ZmtpServer> server;
  std::map<PeerId, Subscriptions> subscribers;
};

}  // namespace

struct RobotEnd::Impl {
  explicit Impl(const Clock& robot_clock) : clock(robot_clock) {}

  Result<void> bind(const LinkAddresses& addresses);
  void run(std::stop_token stop);
  void wait() const;
  void onSubscription(Publisher& publisher, PeerId peer, std::string_view message);
  void tellWanted(const Publisher& publisher);
  void publishWaiting();
  void repeatLatched();
  void transmit(const Outbox::Message& message);

  const Clock& clock;
  std::optional<IpcLock> lock;
  std::unique_ptr<ZmtpServer> commands;
  Publisher status{Lane::Status, publisherLimits(64, 1 << 20), nullptr, {}};
  Publisher streams{Lane::Streams, publisherLimits(4, 1 << 19), nullptr, {}};
  WakeEvent wake;
  Outbox outbox;
  BoundedQueue<std::pair<PeerId, std::string>> sends{kSendQueue, DropPolicy::Newest};
  std::atomic<std::uint64_t> failed_sends{0};
  Handlers handlers;
  std::array<Monotonic::time_point, kTopicCount> last_repeat{};
  std::jthread thread;
};

Result<void> RobotEnd::Impl::bind(const LinkAddresses& addresses) {
  auto bound = ZmtpServer::bind(addresses.command, ZmtpKind::Router, {});
  if (!bound) return tl::make_unexpected(bound.error());
  commands = std::move(*bound);
  for (auto [publisher, address] :
       {std::pair{&status, &addresses.status}, {&streams, &addresses.streams}}) {
    auto server = ZmtpServer::bind(*address, ZmtpKind::Publisher, publisher->limits);
    if (!server) return tl::make_unexpected(server.error());
    publisher->server = std::move(*server);
    publisher->server->setHandlers(
        {[this, publisher = publisher](PeerId peer, std::string_view message) {
           onSubscription(*publisher, peer, message);
         },
         [this, publisher = publisher](PeerId peer) {
           if (publisher->subscribers.erase(peer) > 0) tellWanted(*publisher);
         },
         {}});
  }
  return {};
}

Result<std::unique_ptr<RobotEnd>> RobotEnd::bind(const LinkAddresses& addresses,
                                                 const Clock& clock) {
  auto impl = std::make_unique<Impl>(clock);
  if (!addresses.ipc_prefix.empty()) {
    auto lock = IpcLock::acquire(addresses.ipc_prefix);
    if (!lock) return tl::make_unexpected(lock.error());
    impl->lock.emplace(std::move(*lock));
  }
  if (auto ok = impl->bind(addresses); !ok) return tl::make_unexpected(ok.error());
  return std::unique_ptr<RobotEnd>(new RobotEnd(std::move(impl)));
}

RobotEnd::RobotEnd(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

RobotEnd::~RobotEnd() {
  impl_->thread.request_stop();
  impl_->wake.notify();
  if (impl_->thread.joinable()) impl_->thread.join();
}

void RobotEnd::start(Handlers handlers) {
  impl_->handlers = std::move(handlers);
  impl_->commands->setHandlers({impl_->handlers.on_message, impl_->handlers.on_closed, {}});
  impl_->thread = std::jthread([impl = impl_.get()](std::stop_token stop) { impl->run(stop); });
}

void RobotEnd::send(PeerId peer, std::string message) {
  impl_->sends.push({peer, std::move(message)});
  impl_->wake.notify();
}

void RobotEnd::keep(PeerId peer, bool known) { impl_->commands->keep(peer, known); }
std::string RobotEnd::nameOf(PeerId peer) const { return impl_->commands->nameOf(peer); }

void RobotEnd::publish(Topic topic, Outbox::Encode encode) {
  impl_->outbox.push(topic, std::move(encode), impl_->clock.now());
  impl_->wake.notify();
}

bool RobotEnd::subscribed(Topic topic) const { return impl_->outbox.subscribed(topic); }
std::uint64_t RobotEnd::dropped(Topic topic) const { return impl_->outbox.dropped(topic); }
std::uint64_t RobotEnd::droppedSends() const {
  return impl_->sends.dropped() + impl_->failed_sends.load();
}

void RobotEnd::Impl::wait() const {
  double wait_s = std::min(kTick_s, outbox.waits(monotonicNow()).value_or(kTick_s));
  std::array<pollfd, 4> items{};
  std::size_t n = 0;
  for (const ZmtpServer* server : {commands.get(), status.server.get(), streams.server.get()}) {
    wait_s = std::min(wait_s, server->wait_s());
    items.at(n++) = {server->fd(), POLLIN, 0};
  }
  items.at(n++) = {wake.fd(), POLLIN, 0};
  ::poll(items.data(), n, static_cast<int>(std::ceil(wait_s * 1e3)));
}

void RobotEnd::Impl::run(std::stop_token stop) {
  Monotonic::time_point last_tick{};
  while (!stop.stop_requested()) {
    wait();
    wake.clear();
    status.server->serve();
    streams.server->serve();
    commands->serve();
    for (auto& [peer, message] : sends.drain()) {
      if (!commands->send(peer, frameMessage({message}))) ++failed_sends;
    }
    publishWaiting();
    if (secondsBetween(last_tick, monotonicNow()) < kTick_s) continue;
    last_tick = monotonicNow();
    repeatLatched();
    handlers.on_tick();
  }
}

void RobotEnd::Impl::onSubscription(Publisher& publisher, PeerId peer, std::string_view message) {
  auto& subscriptions =
      publisher.subscribers.try_emplace(peer, Subscriptions(publisher.lane)).first->second;
  const auto fresh = subscriptions.take(message);
  tellWanted(publisher);
  for (const Topic topic : fresh) {
    if (!topicInfo(topic).latched) continue;
    const auto newest = outbox.newest(topic, clock.now());
    if (newest && !publisher.server->send(peer, framed(*newest))) ++failed_sends;
  }
}

/// What nobody wants need not be encoded.
void RobotEnd::Impl::tellWanted(const Publisher& publisher) {
  for (const TopicInfo& info : topicTable()) {
    if (info.lane != publisher.lane) continue;
    outbox.setSubscribed(
        info.topic, std::any_of(publisher.subscribers.begin(), publisher.subscribers.end(),
                                [&](const auto& row) { return row.second.wants(info.topic); }));
  }
}

void RobotEnd::Impl::publishWaiting() {
  // One stream message at a time: commands and status are looked at between two clouds.
  while (const auto message = outbox.take(monotonicNow())) {
    transmit(*message);
    if (topicInfo(message->topic).lane == Lane::Streams) break;
  }
  if (outbox.waits(monotonicNow()).value_or(1.0) <= 0.0) wake.notify();
}

void RobotEnd::Impl::repeatLatched() {
  const auto now = monotonicNow();
  for (const TopicInfo& info : topicTable()) {
    auto& last = last_repeat[static_cast<std::size_t>(info.topic)];
    if (!info.latched || secondsBetween(last, now) < info.repeat_s) continue;
    last = now;
    if (!outbox.subscribed(info.topic)) continue;
    if (const auto newest = outbox.again(info.topic, clock.now())) transmit(*newest);
  }
}

void RobotEnd::Impl::transmit(const Outbox::Message& message) {
  const Publisher& publisher = topicInfo(message.topic).lane == Lane::Status ? status : streams;
  const ZmtpMessage bytes = framed(message);
  for (const auto& [peer, subscriptions] : publisher.subscribers) {
    // One that does not keep up misses this message; it sees the gap in the sequence and counts it.
    if (subscriptions.wants(message.topic) && !publisher.server->send(peer, bytes)) ++failed_sends;
  }
}

}  // namespace kiln
