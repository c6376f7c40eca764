#include "tests/support/raw_zmtp.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

namespace kiln::test {
namespace {

constexpr unsigned kMore = 1, kLong = 2, kCommand = 4;
constexpr std::size_t kGreeting = 64;

std::string property(std::string_view name, std::string_view value) {
  std::string out(1, static_cast<char>(name.size()));
  out.append(name).append(3, '\0');
  out += static_cast<char>(value.size());
  return out.append(value);
}

UniqueFd connectTo(const std::string& address) {
  if (address.starts_with("ipc://")) {
    sockaddr_un to{};
    to.sun_family = AF_UNIX;
    std::strncpy(to.sun_path, address.c_str() + 6, sizeof to.sun_path - 1);
    UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const bool ok = ::connect(fd.get(), reinterpret_cast<sockaddr*>(&to), sizeof to) == 0;
    return ok ? std::move(fd) : UniqueFd();
  }
  const std::size_t colon = address.rfind(':');
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(colon + 1))));
  ::inet_pton(AF_INET, address.substr(6, colon - 6).c_str(), &to.sin_addr);
  UniqueFd fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const bool ok = ::connect(fd.get(), reinterpret_cast<sockaddr*>(&to), sizeof to) == 0;
  return ok ? std::move(fd) : UniqueFd();
}

bool waitFor(int fd, short events, Duration limit) {
  pollfd item{fd, events, 0};
  return ::poll(&item, 1, static_cast<int>(limit / std::chrono::milliseconds(1))) > 0;
}

}  // namespace

std::string zmtpFrame(std::string_view body, unsigned flags) {
  std::string out;
  if (body.size() < 256) {
    out += static_cast<char>(flags);
    out += static_cast<char>(body.size());
  } else {
    out += static_cast<char>(flags | kLong);
    for (int shift = 56; shift >= 0; shift -= 8)
      out += static_cast<char>((std::uint64_t{body.size()} >> shift) & 0xFFu);
  }
  return out.append(body);
}

RawZmtp::RawZmtp(const std::string& address) : fd_(connectTo(address)) {}

bool RawZmtp::sendRaw(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::send(fd_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(n));
    } else if (errno != EAGAIN || !waitFor(fd_.get(), POLLOUT, std::chrono::seconds(1))) {
      return false;
    }
  }
  return true;
}

bool RawZmtp::send(std::string_view message, bool more) {
  return sendRaw(zmtpFrame(message, more ? kMore : 0));
}

bool RawZmtp::shakeHands(std::string_view socket_type, std::string_view identity) {
  std::string greeting("\xFF\0\0\0\0\0\0\0\1\x7F\3\0NULL", 16);
  greeting.resize(kGreeting, '\0');
  std::string ready("\5READY");
  ready += property("Socket-Type", socket_type) + property("Identity", identity);
  if (!sendRaw(greeting + zmtpFrame(ready, kCommand))) return false;
  while (in_.size() < kGreeting + 2 ||
         in_.size() < kGreeting + 2 + static_cast<std::uint8_t>(in_[kGreeting + 1])) {
    if (!readMore(std::chrono::seconds(2))) return false;
  }
  in_.erase(0, kGreeting + 2 + static_cast<std::uint8_t>(in_[kGreeting + 1]));
  return true;
}

bool RawZmtp::readMore(Duration limit) {
  std::array<char, 65536> part{};
  if (!waitFor(fd_.get(), POLLIN, limit)) return false;
  const ssize_t n = ::recv(fd_.get(), part.data(), part.size(), MSG_DONTWAIT);
  closed_ = n == 0 || (n < 0 && errno != EAGAIN);
  if (n > 0) in_.append(part.data(), static_cast<std::size_t>(n));
  return n > 0;
}

std::optional<std::string> RawZmtp::receive(Duration limit) {
  std::string message;
  for (;;) {
    while (in_.size() >= 2) {
      const auto flags = static_cast<unsigned char>(in_[0]);
      const std::size_t header = (flags & kLong) != 0 ? 9 : 2;
      if (in_.size() < header) break;
      std::size_t size = 0;
      for (std::size_t i = 1; i < header; ++i) size = size << 8 | static_cast<std::uint8_t>(in_[i]);
      if (in_.size() < header + size) break;
      message += in_.substr(header, size);
      in_.erase(0, header + size);
      if ((flags & kMore) == 0) return message;
    }
    if (!readMore(limit)) return std::nullopt;
  }
}

bool RawZmtp::closedWithin(Duration limit) {
  while (!closed_ && readMore(limit)) in_.clear();
  return closed_;
}

}  // namespace kiln::test
