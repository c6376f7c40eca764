#include "common/transport/endpoint.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace kiln {
namespace {

constexpr std::string_view kTcp = "tcp://";
constexpr std::string_view kIpc = "ipc://";
constexpr std::size_t kMaxIpcPath = 100;  // a unix socket address holds 107 characters
constexpr int kSockets = 4;

tl::unexpected<Error> refuseAddress(const std::string& endpoint) {
  return makeError(
      ErrorCode::Refused,
      "{}: only ipc and loopback addresses are accepted, because messages are not authenticated "
      "until "
      "keys exist; use tcp://127.0.0.1:PORT, or an ssh tunnel to it from another machine",
      endpoint);
}

bool isLoopback(std::string_view host) {
  return host == "localhost" || host == "[::1]" ||
         (host.starts_with("127.") &&
          host.find_first_not_of("0123456789.") == std::string_view::npos);
}

Result<LinkAddresses> parseTcp(const std::string& endpoint) {
  const std::string_view rest = std::string_view(endpoint).substr(kTcp.size());
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos) {
    return makeError(ErrorCode::InvalidInput, "{}: no port; write tcp://127.0.0.1:7300", endpoint);
  }
  const std::string_view host = rest.substr(0, colon);
  const std::string_view digits = rest.substr(colon + 1);
  int port = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (problem != std::errc{} || end != digits.data() + digits.size() || port < 1 ||
      port > 65535 - kSockets + 1) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: '{}' is no port from 1 to {} (four in a row are used)", endpoint, digits,
                     65535 - kSockets + 1);
  }
  if (!isLoopback(host)) return refuseAddress(endpoint);
  const auto at = [&](int offset) {
    return fmt::format("{}{}:{}", kTcp, host == "localhost" ? "127.0.0.1" : host, port + offset);
  };
  return LinkAddresses{at(0), at(1), at(2), at(3), ""};
}

Result<LinkAddresses> parseIpc(const std::string& endpoint) {
  const std::string prefix = endpoint.substr(kIpc.size());
  if (!prefix.starts_with('/') || prefix.ends_with('/')) {
    return makeError(ErrorCode::InvalidInput, "{}: write ipc:///dir/prefix with an absolute path",
                     endpoint);
  }
  const std::string longest = prefix + ".command";
  if (longest.size() > kMaxIpcPath) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: the path has {} characters, {} fit; use a shorter one, e.g. in /tmp",
                     endpoint, longest.size(), kMaxIpcPath);
  }
  std::error_code ec;
  const std::string folder = std::filesystem::path(prefix).parent_path();
  if (!std::filesystem::is_directory(folder, ec)) {
    return makeError(ErrorCode::NotFound, "{}: there is no folder {}; create it first", endpoint,
                     folder);
  }
  const auto at = [&](const char* name) { return fmt::format("{}{}.{}", kIpc, prefix, name); };
  return LinkAddresses{at("command"), at("status"), at("streams"), at("stop"), prefix};
}

}  // namespace

Result<LinkAddresses> parseEndpoint(const std::string& endpoint) {
  if (endpoint.starts_with(kTcp)) return parseTcp(endpoint);
  if (endpoint.starts_with(kIpc)) return parseIpc(endpoint);
  return refuseAddress(endpoint);
}

Result<IpcLock> IpcLock::acquire(const std::string& prefix) {
  const std::string path = prefix + ".lock";
  const int fd = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  if (fd < 0) {
    return makeError(ErrorCode::Storage,
                     "{}: cannot be created ({}); choose a folder you may write to", path,
                     std::strerror(errno));
  }
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
    ::close(fd);
    return makeError(
        ErrorCode::Unavailable,
        "ipc://{} is in use by another robot daemon; stop that one or choose another endpoint",
        prefix);
  }
  return IpcLock(fd);
}

IpcLock::IpcLock(IpcLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

IpcLock::~IpcLock() {
  if (fd_ >= 0) ::close(fd_);
}

}  // namespace kiln
