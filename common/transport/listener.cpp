#include "common/transport/listener.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "common/core/text.h"

namespace kiln {
namespace {

constexpr std::string_view kTcp = "tcp://", kIpc = "ipc://";
constexpr int kBacklog = 128;
constexpr int kKind = SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC;

tl::unexpected<Error> cannotBind(const std::string& address) {
  if (errno == EADDRINUSE) {
    return makeError(
        ErrorCode::Unavailable,
        "{} is in use, perhaps by another robot daemon; stop that one or choose another endpoint",
        address);
  }
  return makeError(ErrorCode::Unavailable, "{} cannot be bound: {}; choose another endpoint",
                   address, std::strerror(errno));
}

UniqueFd listenTcp(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  std::string host = address.substr(kTcp.size(), colon - kTcp.size());
  if (host.starts_with('[')) host = host.substr(1, host.size() - 2);
  if (host == "localhost") host = "127.0.0.1";
  addrinfo hints{};
  hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  errno = EADDRNOTAVAIL;
  if (::getaddrinfo(host.c_str(), address.substr(colon + 1).c_str(), &hints, &found) != 0)
    return UniqueFd();
  UniqueFd fd(::socket(found->ai_family, kKind, 0));
  const int on = 1;
  const bool bound = ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
                     ::bind(fd.get(), found->ai_addr, found->ai_addrlen) == 0 &&
                     ::listen(fd.get(), kBacklog) == 0;
  const int why = errno;
  ::freeaddrinfo(found);
  errno = why;
  return bound ? std::move(fd) : UniqueFd();
}

UniqueFd listenIpc(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  errno = ENAMETOOLONG;
  if (path.size() >= sizeof address.sun_path) return UniqueFd();
  std::memcpy(address.sun_path, path.data(), path.size());
  UniqueFd fd(::socket(AF_UNIX, kKind, 0));
  ::unlink(path.c_str());  // of a process that was killed; that none lives is the caller's lock
  const auto* raw = reinterpret_cast<const sockaddr*>(&address);
  const bool bound =
      ::bind(fd.get(), raw, sizeof address) == 0 && ::listen(fd.get(), kBacklog) == 0;
  return bound ? std::move(fd) : UniqueFd();
}

int processBehind(int fd) {
  ucred who{};
  socklen_t size = sizeof who;
  const bool known = ::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &who, &size) == 0;
  return known && who.pid > 0 ? who.pid : 0;
}

std::string nameOf(const sockaddr_storage& address, socklen_t size) {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (::getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, host.data(), host.size(),
                    port.data(), port.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return "somebody";
  }
  return fmt::format("{}:{}", host.data(), port.data());
}

UniqueFd spare() { return UniqueFd(::open("/dev/null", O_RDONLY | O_CLOEXEC)); }

}  // namespace

UniqueFd::UniqueFd(UniqueFd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
UniqueFd& UniqueFd::operator=(UniqueFd&& other) noexcept {
  reset(std::exchange(other.fd_, -1));
  return *this;
}
void UniqueFd::reset(int fd) {
  if (fd_ >= 0) ::close(fd_);
  fd_ = fd;
}

Listener::Listener(UniqueFd fd, std::string path)
    : fd_(std::move(fd)), reserve_(spare()), path_(std::move(path)) {}

Listener::~Listener() {
  if (fd_.get() >= 0 && !path_.empty()) ::unlink(path_.c_str());
}

Result<Listener> Listener::bind(const std::string& address) {
  const bool tcp = address.starts_with(kTcp);
  const std::string path = tcp ? "" : address.substr(kIpc.size());
  UniqueFd fd = tcp ? listenTcp(address) : listenIpc(path);
  if (fd.get() < 0) return cannotBind(address);
  return Listener(std::move(fd), path);
}

Accepted Listener::accept() {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  Accepted out;
  out.fd.reset(::accept4(fd_.get(), reinterpret_cast<sockaddr*>(&address), &size,
                         SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (out.fd.get() < 0) {
    if (errno == EMFILE || errno == ENFILE) turnAway();
    return out;
  }
  const int on = 1;
  if (address.ss_family == AF_UNIX) {
    out.process = processBehind(out.fd.get());
  } else {
    ::setsockopt(out.fd.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }
  if (out.process == 0) out.address = nameOf(address, size);
  return out;
}

std::string Accepted::name() const {
  if (process == 0) return address;
  std::string program;
  std::ifstream file(fmt::format("/proc/{}/comm", process));
  std::getline(file, program);
  return fmt::format("process {} ({})", process, printableName(program));
}

void Listener::turnAway() {
  reserve_.reset();
  const UniqueFd caller(::accept4(fd_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  reserve_ = spare();
}

std::size_t affordableDescriptors(std::size_t wanted) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return wanted;
  return std::clamp<std::size_t>(limit.rlim_cur / 8, 2, wanted);
}

}  // namespace kiln
