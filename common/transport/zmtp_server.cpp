#include "common/transport/zmtp_server.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include "common/core/check.h"
#include "common/transport/listener.h"
#include "common/transport/log_throttle.h"

namespace kiln {
namespace {

constexpr std::size_t kRead = 16 << 10;  // at a time
constexpr double kLeastRead = 256.0;     // bytes: what a read costs, however little it brings
constexpr int kEvents = 64;
constexpr double kHandshake_s = 2.0;
constexpr double kAcceptsPerSecond = 500.0, kAcceptBurst = 64.0;
constexpr double kMessageBurst = 100.0, kFirstMessages = 30.0;
constexpr double kRetry_s = 0.01;  ///< of a peer that is read slowly

/// How much may be taken now; refills with time. May be overdrawn once.
struct Budget {
  double rate_per_s, most, left;
  Monotonic::time_point refilled = monotonicNow();

  void refill(Monotonic::time_point now) {
    left = std::min(most, left + rate_per_s * secondsBetween(refilled, now));
    refilled = now;
  }
  [[nodiscard]] bool any() const { return left >= 1.0; }
};

struct Connection {
  Accepted who;
  ZmtpPeer peer;
  Budget messages, bytes;
  Monotonic::time_point since = monotonicNow();
  bool kept = false;     ///< known to the caller
  bool stalled = false;  ///< beyond its share: not read until its budget has refilled
  bool gone = false;
  std::deque<ZmtpMessage> waiting{};
  std::size_t written = 0;  ///< of waiting.front()
  std::size_t waiting_bytes = 0;
  std::uint32_t events = 0;  ///< what epoll watches
};

}  // namespace

struct ZmtpServer::Impl {
  Impl(Listener l, ZmtpKind k, Limits lim)
      : listener(std::move(l)), kind(k), limits(lim), epoll(::epoll_create1(EPOLL_CLOEXEC)) {
    KILN_CHECK(epoll.get() >= 0, "no file descriptors left");
    limits.max_peers = affordableDescriptors(limits.max_peers);
    watch(listener.fd(), 0, EPOLLIN, EPOLL_CTL_ADD);
  }
  void watch(int fd, PeerId id, std::uint32_t events, int operation) const;
  void watchAsNeeded(PeerId id, Connection& c) const;
  void acceptSome(Monotonic::time_point now);
  bool makeRoom();
  void read(PeerId id, Connection& c);
  void takeMessages(PeerId id, Connection& c);
  void write(Connection& c) const;
  void close(Connection& c, const std::string& why);
  void reap();

  Listener listener;
  ZmtpKind kind;
  Limits limits;
  UniqueFd epoll;
  Handlers handlers;
  std::map<PeerId, Connection> connections;  // by age
  PeerId last_id = 0;
  Budget accepts{kAcceptsPerSecond, kAcceptBurst, kAcceptBurst};
  bool accepting = true;
  std::vector<char> buffer = std::vector<char>(kRead);
  LogThrottle closed_log{"link"}, full_log{"link"};
};

Result<std::unique_ptr<ZmtpServer>> ZmtpServer::bind(const std::string& address, ZmtpKind kind,
                                                     Limits limits) {
  auto listener = Listener::bind(address);
  if (!listener) return tl::make_unexpected(listener.error());
  return std::unique_ptr<ZmtpServer>(
      new ZmtpServer(std::make_unique<Impl>(std::move(*listener), kind, limits)));
}

ZmtpServer::ZmtpServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ZmtpServer::~ZmtpServer() = default;
void ZmtpServer::setHandlers(Handlers handlers) { impl_->handlers = std::move(handlers); }
int ZmtpServer::fd() const { return impl_->epoll.get(); }

void ZmtpServer::Impl::watch(int fd, PeerId id, std::uint32_t events, int operation) const {
  epoll_event event{};
  event.events = events;
  event.data.u64 = id;
  ::epoll_ctl(epoll.get(), operation, fd, &event);
}

void ZmtpServer::Impl::watchAsNeeded(PeerId id, Connection& c) const {
  const std::uint32_t events =
      (c.stalled ? 0u : EPOLLIN) | (c.waiting.empty() ? 0u : EPOLLOUT) | 0u;
  if (events == std::exchange(c.events, events)) return;
  watch(c.who.fd.get(), id, events, EPOLL_CTL_MOD);
}

void ZmtpServer::Impl::close(Connection& c, const std::string& why) {
  if (std::exchange(c.gone, true) || why.empty()) return;
  closed_log.warn("{} is disconnected: {}", c.who.name(), why);
}

/// Whom a newcomer may displace: who has not shaken hands, else the oldest of the process that has
/// most connections, but nobody whom the caller knows. Nobody is judged by what he has said and
/// nobody has read yet. @return false: all are known.
bool ZmtpServer::Impl::makeRoom() {
  full_log.warn("{} connections at one socket are too many; the last came from {}",
                connections.size(), connections.rbegin()->second.who.name());
  std::map<int, int> by_process;
  for (const auto& [id, c] : connections) ++by_process[c.who.process];
  const auto rank = [&](const Connection& c) {
    return std::pair(!c.peer.ready(), by_process[c.who.process]);
  };
  for (;;) {
    auto victim = connections.end();
    for (auto at = connections.begin(); at != connections.end(); ++at) {
      if (at->second.kept || at->second.gone) continue;
      if (victim == connections.end() || rank(at->second) > rank(victim->second)) victim = at;
    }
    if (victim == connections.end()) return false;
    Connection& c = victim->second;
    if (!c.peer.ready()) {
      read(victim->first, c);
      if (c.peer.ready() && !c.gone) continue;  // each only once
    }
    close(c, "");
    reap();
    return true;
  }
}

void ZmtpServer::Impl::acceptSome(Monotonic::time_point now) {
  accepts.refill(now);
  while (accepts.any()) {
    Accepted caller = listener.accept();
    if (caller.fd.get() < 0) break;
    accepts.left -= 1.0;
    if (connections.size() >= limits.max_peers && !makeRoom()) continue;
    const int fd = caller.fd.get();
    const PeerId id = ++last_id;
    auto [at, fresh] = connections.try_emplace(
        id, Connection{std::move(caller),
                       ZmtpPeer(kind, limits.max_message_bytes),
                       {limits.messages_per_s, kMessageBurst, kFirstMessages},
                       {limits.bytes_per_s, limits.bytes_per_s, limits.bytes_per_s}});
    Connection& c = at->second;
    c.events = EPOLLIN;
    watch(fd, id, c.events, EPOLL_CTL_ADD);
    takeMessages(id, c);  // nothing came yet: this sends our greeting
  }
  if (accepting == accepts.any()) return;
  accepting = accepts.any();
  watch(listener.fd(), 0, accepting ? EPOLLIN : 0u, EPOLL_CTL_MOD);
}

void ZmtpServer::Impl::read(PeerId id, Connection& c) {
  const ssize_t n = ::recv(c.who.fd.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) return close(c, "");
  if (n < 0) return;
  c.bytes.left -= std::max(kLeastRead, static_cast<double>(n));
  c.peer.feed({buffer.data(), static_cast<std::size_t>(n)});
  takeMessages(id, c);
}

/// As many messages as its budget allows; the rest waits unread.
void ZmtpServer::Impl::takeMessages(PeerId id, Connection& c) {
  while (!c.gone && c.messages.any()) {
    const auto message = c.peer.next();
    std::string out = c.peer.takeOutput();
    if (!out.empty() && c.waiting.size() < limits.max_queued) {
      c.waiting_bytes += out.size();
      c.waiting.push_back(std::make_shared<const std::string>(std::move(out)));
    }
    if (!message) {
      if (c.peer.ready() && handlers.on_violation) handlers.on_violation(id);
      close(c, message.error().message);
      break;
    }
    if (!*message) break;
    c.messages.left -= 1.0;
    handlers.on_message(id, **message);
  }
  c.stalled = !c.messages.any() || !c.bytes.any();
  if (!c.gone) write(c);
  if (!c.gone) watchAsNeeded(id, c);
}

void ZmtpServer::Impl::write(Connection& c) const {
  while (!c.waiting.empty()) {
    const std::string& front = *c.waiting.front();
    const ssize_t n = ::send(c.who.fd.get(), front.data() + c.written, front.size() - c.written,
                             MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n < 0) {
      c.gone = errno != EAGAIN && errno != EINTR;
      return;
    }
    c.written += static_cast<std::size_t>(n);
    if (c.written < front.size()) continue;
    c.waiting_bytes -= front.size();
    c.written = 0;
    c.waiting.pop_front();
  }
}

void ZmtpServer::Impl::reap() {
  for (auto at = connections.begin(); at != connections.end();) {
    if (!at->second.gone) {
      ++at;
      continue;
    }
    const PeerId id = at->first;
    at = connections.erase(at);
    if (handlers.on_closed) handlers.on_closed(id);
  }
}

void ZmtpServer::serve() {
  Impl& s = *impl_;
  std::array<epoll_event, kEvents> events{};
  const int n = ::epoll_wait(s.epoll.get(), events.data(), kEvents, 0);
  const auto now = monotonicNow();
  for (auto& [id, c] : s.connections) {
    c.messages.refill(now);
    c.bytes.refill(now);
    if (c.stalled) s.takeMessages(id, c);
    if (!c.peer.ready() && secondsBetween(c.since, now) > kHandshake_s) s.close(c, "");
  }
  bool callers = !s.accepting;
  for (int i = 0; i < n; ++i) {
    const epoll_event& event = events.at(static_cast<std::size_t>(i));
    callers = callers || event.data.u64 == 0;
    const auto at = s.connections.find(event.data.u64);
    if (at == s.connections.end() || at->second.gone) continue;
    Connection& c = at->second;
    if ((event.events & (EPOLLERR | EPOLLHUP)) != 0 && c.stalled) s.close(c, "");
    if ((event.events & EPOLLOUT) != 0) s.write(c);
    if ((event.events & (EPOLLIN | EPOLLERR | EPOLLHUP)) != 0 && !c.stalled) s.read(at->first, c);
    if (!c.gone) s.watchAsNeeded(at->first, c);
  }
  s.reap();
  if (callers) s.acceptSome(now);
}

double ZmtpServer::wait_s() const {
  const bool slow = std::any_of(impl_->connections.begin(), impl_->connections.end(),
                                [](const auto& row) { return row.second.stalled; });
  return slow || !impl_->accepting ? kRetry_s : kHandshake_s;
}

bool ZmtpServer::send(PeerId to, const ZmtpMessage& message) {
  const auto at = impl_->connections.find(to);
  if (at == impl_->connections.end() || at->second.gone || !at->second.peer.ready()) return false;
  Connection& c = at->second;
  const bool fits =
      c.waiting.empty() || (c.waiting.size() < impl_->limits.max_queued &&
                            c.waiting_bytes + message->size() <= impl_->limits.max_queued_bytes);
  if (!fits) return false;
  c.waiting.push_back(message);
  c.waiting_bytes += message->size();
  if (c.waiting.size() == 1) impl_->write(c);
  impl_->watchAsNeeded(to, c);
  return !c.gone;
}

void ZmtpServer::keep(PeerId peer, bool known) {
  const auto at = impl_->connections.find(peer);
  if (at == impl_->connections.end()) return;
  if (std::exchange(at->second.kept, known) || !known) return;
  const auto widen = [](Budget& budget, double rate_per_s) {
    budget.rate_per_s = rate_per_s;
    budget.most = std::max(budget.most, rate_per_s);
  };
  widen(at->second.messages, impl_->limits.kept_messages_per_s);
  widen(at->second.bytes, impl_->limits.kept_bytes_per_s);
}

std::string ZmtpServer::nameOf(PeerId peer) const {
  const auto at = impl_->connections.find(peer);
  return at == impl_->connections.end() ? "somebody who has gone" : at->second.who.name();
}

}  // namespace kiln
