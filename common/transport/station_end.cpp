#include "common/transport/station_end.h"

#include <array>
#include <atomic>
#include <deque>
#include <random>
#include <thread>
#include <utility>

#include "common/core/bounded_queue.h"
#include "common/core/text.h"
#include "common/transport/monotonic.h"
#include "common/transport/wake_event.h"
#include "common/transport/zmq_socket.h"

namespace kiln {
namespace {

constexpr int kLastWords_ms = 50;  // a closing client's releases
constexpr std::size_t kSendQueue = 64;
constexpr std::size_t kMostDelayed = 256;
constexpr int kStatusHwm = 64;
constexpr int kStreamsHwm = 4;
constexpr int kSubscriptionsHwm = 64;  // a subscription that does not fit is silently lost
constexpr std::int64_t kMaxStreamBytes = 16 << 20;

}  // namespace

struct StationEnd::Impl {
  explicit Impl(Options opts)
      : options(std::move(opts)),
        commands(context, SocketKind::Dealer,
                 {.routing_id = options.client_id, .linger_ms = kLastWords_ms}),
        status(context, SocketKind::Sub, {kSubscriptionsHwm, kStatusHwm, kMaxStreamBytes}),
        streams(context, SocketKind::Sub, {kSubscriptionsHwm, kStreamsHwm, kMaxStreamBytes}),
        random(options.faults.seed) {}

  void run(std::stop_token stop);
  void receiveReplies();
  void receivePublished(ZmqSocket& socket);
  void sendWaiting();
  void transmit(const std::string& message);
  bool lose(double share) {
    if (share <= 0.0 || std::uniform_real_distribution<double>(0.0, 1.0)(random) >= share)
      return false;
    ++faulted;
    return true;
  }

  Options options;
  ZmqContext context;
  ZmqSocket commands, status, streams;
  WakeEvent wake;
  BoundedQueue<std::string> sends{kSendQueue, DropPolicy::Newest};
  std::deque<std::pair<Monotonic::time_point, std::string>> delayed;
  std::array<SequenceCounter, kTopicCount> sequences;
  std::mt19937_64 random;
  std::atomic<std::uint64_t> failed_sends{0};
  std::atomic<std::uint64_t> faulted{0};
  Handlers handlers;
  std::jthread thread;
};

Result<std::unique_ptr<StationEnd>> StationEnd::connect(const LinkAddresses& addresses,
                                                        Options options) {
  auto impl = std::make_unique<Impl>(std::move(options));
  for (auto [socket, address] : {std::pair{&impl->commands, &addresses.command},
                                 {&impl->status, &addresses.status},
                                 {&impl->streams, &addresses.streams}}) {
    if (auto ok = socket->connect(*address); !ok) return tl::make_unexpected(ok.error());
  }
  for (const Topic topic : impl->options.topics) {
    const TopicInfo& info = topicInfo(topic);
    (info.lane == Lane::Status ? impl->status : impl->streams).subscribe(info.name);
  }
  return std::unique_ptr<StationEnd>(new StationEnd(std::move(impl)));
}

StationEnd::StationEnd(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

StationEnd::~StationEnd() {
  impl_->thread.request_stop();
  impl_->wake.notify();
  if (impl_->thread.joinable()) impl_->thread.join();
}

void StationEnd::start(Handlers handlers) {
  impl_->handlers = std::move(handlers);
  impl_->thread = std::jthread([impl = impl_.get()](std::stop_token stop) { impl->run(stop); });
}

bool StationEnd::send(std::string message) {
  const bool queued = impl_->sends.push(std::move(message));
  impl_->wake.notify();
  return queued;
}

void StationEnd::wake() { impl_->wake.notify(); }
std::uint64_t StationEnd::droppedSends() const {
  return impl_->sends.dropped() + impl_->failed_sends.load();
}
std::uint64_t StationEnd::faulted() const { return impl_->faulted.load(); }

void StationEnd::Impl::run(std::stop_token stop) {
  Monotonic::time_point next_tick = monotonicNow();
  const auto tick = std::chrono::duration_cast<Monotonic::duration>(
      std::chrono::duration<double>(options.tick_s));
  while (!stop.stop_requested()) {
    const double wait_s = std::max(0.0, secondsBetween(monotonicNow(), next_tick));
    waitReadable({&commands, &status, &streams}, wake.fd(), static_cast<int>(wait_s * 1e3 + 0.999));
    wake.clear();
    receiveReplies();
    receivePublished(status);
    receivePublished(streams);
    sendWaiting();
    if (monotonicNow() < next_tick) continue;
    handlers.on_tick();
    sendWaiting();
    next_tick = std::max(next_tick + tick, monotonicNow());
  }
  sendWaiting();  // the releases of a session that ends
}

void StationEnd::Impl::receiveReplies() {
  while (const auto parts = commands.receive()) {
    if (lose(options.faults.down_loss)) continue;
    if (parts->size() == 1) handlers.on_message(parts->front());
  }
}

void StationEnd::Impl::receivePublished(ZmqSocket& socket) {
  constexpr int kMost = 16;  // replies get their turn between
  for (int i = 0; i < kMost; ++i) {
    const auto parts = socket.receive();
    if (!parts) return;
    if (lose(options.faults.down_loss)) continue;
    const auto topic = topicByName(parts->front());
    if (!topic || parts->size() != 3) {
      handlers.on_bad(fmt::format("published message of {} parts under '{}' is not known; dropped",
                                  parts->size(), printableName(parts->front())));
      continue;
    }
    const auto header = decodeFrameHeader((*parts)[1]);
    if (!header) {
      handlers.on_bad(header.error().message);
      continue;
    }
    const std::uint64_t lost = sequences[static_cast<std::size_t>(*topic)].next(header->seq);
    handlers.on_published(*topic, *header, (*parts)[2], lost);
  }
}

void StationEnd::Impl::sendWaiting() {
  const auto now = monotonicNow();
  for (std::string& message : sends.drain()) {
    if (lose(options.faults.up_loss)) continue;
    if (options.faults.up_delay_s <= 0.0) {
      transmit(message);
    } else if (delayed.size() < kMostDelayed) {
      delayed.emplace_back(now, std::move(message));
    } else {
      ++failed_sends;
    }
  }
  while (!delayed.empty() &&
         secondsBetween(delayed.front().first, now) >= options.faults.up_delay_s) {
    transmit(delayed.front().second);
    delayed.pop_front();
  }
}

void StationEnd::Impl::transmit(const std::string& message) {
  if (!commands.send({message})) ++failed_sends;
}

}  // namespace kiln
