#include "common/transport/stop_lane.h"

#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "common/core/mutex.h"
#include "common/core/scheduling.h"
#include "common/transport/monotonic.h"
#include "common/transport/wake_event.h"
#include "common/transport/zmq_socket.h"

namespace kiln {
namespace {
constexpr int kIdle_ms = 200;
constexpr double kRepeat_s = 0.05;
}  // namespace

struct StopServer::Impl {
  explicit Impl(Handler handler)
      : on_request(std::move(handler)), socket(context, SocketKind::Router, {}) {}
  void run(std::stop_token stop) {
    runBeforeOthers();
    while (!stop.stop_requested()) {
      waitReadable({&socket}, wake.fd(), kIdle_ms);
      wake.clear();
      while (const auto parts = socket.receive()) {
        if (parts->size() != 2) continue;
        const std::string answer = on_request((*parts)[1]);
        // An unsent answer is no loss: the request comes again within 50 ms.
        if (!answer.empty()) static_cast<void>(socket.send({(*parts)[0], answer}));
      }
    }
  }
  Handler on_request;
  ZmqContext context;
  ZmqSocket socket;
  WakeEvent wake;
  std::jthread thread;
};

Result<std::unique_ptr<StopServer>> StopServer::bind(const std::string& address,
                                                     Handler on_request) {
  auto impl = std::make_unique<Impl>(std::move(on_request));
  if (auto ok = impl->socket.bind(address); !ok) return tl::make_unexpected(ok.error());
  impl->thread = std::jthread([raw = impl.get()](std::stop_token stop) { raw->run(stop); });
  return std::unique_ptr<StopServer>(new StopServer(std::move(impl)));
}

StopServer::StopServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

StopServer::~StopServer() {
  impl_->thread.request_stop();
  impl_->wake.notify();
  if (impl_->thread.joinable()) impl_->thread.join();
}

struct StopClient::Impl {
  explicit Impl(Handlers h) : handlers(std::move(h)), socket(context, SocketKind::Dealer, {}) {}
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
