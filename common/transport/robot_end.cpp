#include "common/transport/robot_end.h"

#include <array>
#include <atomic>
#include <optional>
#include <thread>
#include <utility>

#include "common/core/bounded_queue.h"
#include "common/transport/wake_event.h"
#include "common/transport/zmq_socket.h"

namespace kiln {
namespace {

constexpr double kTick_s = 0.05;
constexpr std::size_t kSendQueue = 256;
constexpr int kStatusHwm = 64;
constexpr int kStreamsHwm = 4;

}  // namespace

struct RobotEnd::Impl {
  explicit Impl(const Clock& robot_clock)
      : clock(robot_clock),
        commands(context, SocketKind::Router, {}),
        status(context, SocketKind::XPub, {kStatusHwm, kStatusHwm, 1 << 10, ""}),
        streams(context, SocketKind::XPub, {kStreamsHwm, kStatusHwm, 1 << 10, ""}) {}

  void run(std::stop_token stop);
  void receiveCommands();
  void receiveSubscriptions(ZmqSocket& socket);
  void publishWaiting();
  void repeatLatched();
  void transmit(const Outbox::Message& message);

  const Clock& clock;
  std::optional<IpcLock> lock;
  ZmqContext context;
  ZmqSocket commands, status, streams;
  WakeEvent wake;
  Outbox outbox;
  BoundedQueue<std::pair<std::string, std::string>> sends{kSendQueue, DropPolicy::Newest};
  std::atomic<std::uint64_t> failed_sends{0};
  Handlers handlers;
  std::array<Monotonic::time_point, kTopicCount> last_repeat{};
  std::jthread thread;
};

Result<std::unique_ptr<RobotEnd>> RobotEnd::bind(const LinkAddresses& addresses,
                                                 const Clock& clock) {
  auto impl = std::make_unique<Impl>(clock);
  if (!addresses.ipc_prefix.empty()) {
    auto lock = IpcLock::acquire(addresses.ipc_prefix);
    if (!lock) return tl::make_unexpected(lock.error());
    impl->lock.emplace(std::move(*lock));
  }
  for (auto [socket, address] : {std::pair{&impl->commands, &addresses.command},
                                 {&impl->status, &addresses.status},
                                 {&impl->streams, &addresses.streams}}) {
    if (auto ok = socket->bind(*address); !ok) return tl::make_unexpected(ok.error());
  }
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
  impl_->thread = std::jthread([impl = impl_.get()](std::stop_token stop) { impl->run(stop); });
}

void RobotEnd::send(const std::string& peer, std::string message) {
  impl_->sends.push({peer, std::move(message)});
  impl_->wake.notify();
}

void RobotEnd::publish(Topic topic, Outbox::Encode encode) {
  impl_->outbox.push(topic, std::move(encode), impl_->clock.now());
  impl_->wake.notify();
}

bool RobotEnd::subscribed(Topic topic) const { return impl_->outbox.subscribed(topic); }
std::uint64_t RobotEnd::dropped(Topic topic) const { return impl_->outbox.dropped(topic); }
std::uint64_t RobotEnd::droppedSends() const {
  return impl_->sends.dropped() + impl_->failed_sends.load();
}

void RobotEnd::Impl::run(std::stop_token stop) {
  Monotonic::time_point last_tick{};
  while (!stop.stop_requested()) {
    const double wait_s = std::min(kTick_s, outbox.waits(monotonicNow()).value_or(kTick_s));
    waitReadable({&commands, &status, &streams}, wake.fd(), static_cast<int>(wait_s * 1e3 + 0.999));
    wake.clear();
    receiveSubscriptions(status);
    receiveSubscriptions(streams);
    receiveCommands();
    for (const auto& [peer, message] : sends.drain()) {
      if (!commands.send({peer, message})) ++failed_sends;
    }
    publishWaiting();
    if (secondsBetween(last_tick, monotonicNow()) < kTick_s) continue;
    last_tick = monotonicNow();
    repeatLatched();
    handlers.on_tick();
  }
}

void RobotEnd::Impl::receiveCommands() {
  constexpr int kMost = 64;  // then the other sockets get their turn
  for (int i = 0; i < kMost; ++i) {
    const auto parts = commands.receive();
    if (!parts) return;
    if (parts->size() == 2) handlers.on_message((*parts)[0], (*parts)[1]);
  }
}

void RobotEnd::Impl::receiveSubscriptions(ZmqSocket& socket) {
  while (const auto parts = socket.receive()) {
    const std::string& message = parts->front();
    if (message.empty()) continue;
    const auto topic = topicByName(std::string_view(message).substr(1));
    if (!topic) continue;
    const bool subscribe = message[0] == 1;
    outbox.setSubscribed(*topic, subscribe);
    if (!subscribe || !topicInfo(*topic).latched) continue;
    if (const auto newest = outbox.again(*topic, clock.now())) transmit(*newest);
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
  const TopicInfo& info = topicInfo(message.topic);
  ZmqSocket& socket = info.lane == Lane::Status ? status : streams;
  // A subscriber above its high-water mark misses this one; it sees the gap in the sequence and
  // counts it.
  if (!socket.send({info.name, encodeFrameHeader(message.header), message.payload})) ++failed_sends;
}

}  // namespace kiln
