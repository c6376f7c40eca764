#include "common/transport/stop_lane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <poll.h>

#include "common/core/mutex.h"
#include "common/core/scheduling.h"
#include "common/transport/monotonic.h"
#include "common/transport/wake_event.h"
#include "common/transport/zmq_socket.h"
#include "common/transport/zmtp_server.h"

namespace kiln {
namespace {
constexpr int kIdle_ms = 200;
constexpr double kRepeat_s = 0.05;
constexpr std::size_t kMaxRequest = 128 << 10;
constexpr std::size_t kMaxPeers = 256;  // half a second of callers, for who shakes hands slowly
constexpr std::string_view kUnreadable = "\xFF";  // no message of any kind
}  // namespace

struct StopServer::Impl {
  explicit Impl(Handler handler) : on_request(std::move(handler)) {}
  void answer(PeerId peer, std::string_view request) const {
    const std::string answer = on_request(request);
    // An unsent answer is no loss: the request comes again within 50 ms.
    if (!answer.empty()) static_cast<void>(server->send(peer, frameMessage({answer})));
  }
  void run(const std::stop_token& stop) {
    runBeforeOthers();
    while (!stop.stop_requested()) {
      const double wait_s = std::min(1e-3 * kIdle_ms, server->wait_s());
      std::array<pollfd, 2> items{{{server->fd(), POLLIN, 0}, {wake.fd(), POLLIN, 0}}};
      ::poll(items.data(), items.size(), static_cast<int>(std::ceil(wait_s * 1e3)));
      wake.clear();
      server->serve();
    }
  }
  Handler on_request;
  std::unique_ptr<ZmtpServer> server;
  WakeEvent wake;
  std::jthread thread;
};

Result<std::unique_ptr<StopServer>> StopServer::bind(const std::string& address,
                                                     Handler on_request) {
  ZmtpServer::Limits limits;
  limits.max_message_bytes = kMaxRequest;
  limits.max_peers = kMaxPeers;
  auto server = ZmtpServer::bind(address, ZmtpKind::Router, limits);
  if (!server) return tl::make_unexpected(server.error());
  auto impl = std::make_unique<Impl>(std::move(on_request));
  impl->server = std::move(*server);
  impl->server->setHandlers(
      {[raw = impl.get()](PeerId peer, std::string_view request) { raw->answer(peer, request); },
       {},
       [raw = impl.get()](PeerId peer) { raw->answer(peer, kUnreadable); }});
  impl->thread = std::jthread([raw = impl.get()](const std::stop_token& stop) { raw->run(stop); });
  return std::unique_ptr<StopServer>(new StopServer(std::move(impl)));
}

StopServer::StopServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

StopServer::~StopServer() {
  impl_->thread.request_stop();
  impl_->wake.notify();
  if (impl_->thread.joinable()) impl_->thread.join();
}

struct StopClient::Impl {
  explicit Impl(Handlers h)
      : handlers(std::move(h)), socket(context, SocketKind::Dealer, {.linger_ms = 50}) {}
  void run(std::stop_token stop);
  void repeat();

  Handlers handlers;
  ZmqContext context;
  ZmqSocket socket;
  WakeEvent wake;
  Mutex mutex;
  std::optional<std::string> incoming;  // guarded by mutex
  std::optional<std::string> pending;   // stop thread only
  Monotonic::time_point last_sent{};
  std::jthread thread;
};

void StopClient::Impl::run(std::stop_token stop) {
  while (!stop.stop_requested()) {
    waitReadable({&socket}, wake.fd(), pending ? static_cast<int>(kRepeat_s * 1e3) : kIdle_ms);
    wake.clear();
    {
      const std::lock_guard lock(mutex);
      if (incoming) {
        pending = std::exchange(incoming, std::nullopt);
        last_sent = {};
      }
    }
    while (const auto parts = socket.receive()) {
      if (parts->size() == 1 && handlers.on_answer(parts->front())) pending.reset();
    }
    repeat();
  }
}

void StopClient::Impl::repeat() {
  if (!pending || secondsBetween(last_sent, monotonicNow()) < kRepeat_s * 0.9) return;
  last_sent = monotonicNow();
  if (socket.send({*pending})) handlers.on_sent();
}

Result<std::unique_ptr<StopClient>> StopClient::connect(const std::string& address,
                                                        Handlers handlers) {
  auto impl = std::make_unique<Impl>(std::move(handlers));
  if (auto ok = impl->socket.connect(address); !ok) return tl::make_unexpected(ok.error());
  impl->thread = std::jthread([raw = impl.get()](std::stop_token stop) { raw->run(stop); });
  return std::unique_ptr<StopClient>(new StopClient(std::move(impl)));
}

StopClient::StopClient(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

StopClient::~StopClient() {
  impl_->thread.request_stop();
  impl_->wake.notify();
  if (impl_->thread.joinable()) impl_->thread.join();
}

void StopClient::request(std::string message) {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->incoming = std::move(message);
  }
  impl_->wake.notify();
}

}  // namespace kiln
