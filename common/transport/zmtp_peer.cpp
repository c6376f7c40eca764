#include "common/transport/zmtp_peer.h"

#include <cstdint>
#include <utility>

namespace kiln {
namespace {

constexpr std::size_t kGreetingBytes = 64;
constexpr std::size_t kMaxCommandBytes = 1024;  // READY, PING
constexpr std::size_t kMaxPingContext = 16;
constexpr std::uint8_t kMore = 1, kLong = 2, kCommand = 4;
constexpr std::string_view kMechanism{"NULL\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 20};

/// `size` bytes, the most significant first.
std::uint64_t number(std::string_view bytes, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}
void putNumber(std::string& out, std::uint64_t value, int size) {
  for (int i = size - 1; i >= 0; --i) out += static_cast<char>((value >> (8 * i)) & 0xFFu);
}

void putFrame(std::string& out, std::uint8_t flags, std::string_view body) {
  const bool is_long = body.size() > 0xFF;
  out += static_cast<char>(flags | (is_long ? kLong : 0));
  putNumber(out, body.size(), is_long ? 8 : 1);
  out += body;
}

std::string greeting() {
  std::string out("\xFF\0\0\0\0\0\0\0\1\x7F\3\0", 12);  // signature, version 3.0
  out += kMechanism;
  out.resize(kGreetingBytes, '\0');
  return out;
}

void putCommand(std::string& out, std::string_view name, std::string_view body) {
  std::string command(1, static_cast<char>(name.size()));
  command.append(name).append(body);
  putFrame(out, kCommand, command);
}

std::string property(std::string_view name, std::string_view value) {
  std::string out(1, static_cast<char>(name.size()));
  out += name;
  putNumber(out, value.size(), 4);
  return out.append(value);
}

/// Of READY; nullopt if it has none of this name or is malformed.
std::optional<std::string_view> propertyOf(std::string_view list, std::string_view wanted) {
  while (!list.empty()) {
    const auto name_size = static_cast<std::uint8_t>(list[0]);
    if (list.size() < 1u + name_size + 4u) return std::nullopt;
    const std::string_view name = list.substr(1, name_size);
    list.remove_prefix(1u + name_size);
    const std::uint64_t size = number(list, 4);
    list.remove_prefix(4);
    if (list.size() < size) return std::nullopt;
    if (name == wanted) return list.substr(0, size);
    list.remove_prefix(size);
  }
  return std::nullopt;
}

tl::unexpected<Error> refuse(std::string why) {
  return tl::make_unexpected(Error{ErrorCode::Refused, std::move(why)});
}

}  // namespace

ZmtpMessage frameMessage(std::initializer_list<std::string_view> parts) {
  std::string out;
  std::size_t size = 0;
  for (const std::string_view part : parts) size += part.size() + 9;
  out.reserve(size);
  std::size_t left = parts.size();
  for (const std::string_view part : parts) putFrame(out, --left > 0 ? kMore : 0, part);
  return std::make_shared<const std::string>(std::move(out));
}

ZmtpPeer::ZmtpPeer(ZmtpKind kind, std::size_t max_message_bytes)
    : kind_(kind), max_message_bytes_(max_message_bytes), out_(greeting()) {}

std::string ZmtpPeer::takeOutput() { return std::exchange(out_, {}); }

Result<std::optional<std::string_view>> ZmtpPeer::next() {
  in_.erase(0, std::exchange(at_, 0));
  if (in_.empty() && in_.capacity() > kMaxCommandBytes) in_.shrink_to_fit();
  if (state_ == State::Greeting) {
    const auto done = readGreeting();
    if (!done) return tl::make_unexpected(done.error());
    if (!*done) return std::nullopt;
  }
  for (;;) {
    const auto frame = readFrame();
    if (!frame) return tl::make_unexpected(frame.error());
    if (!*frame) return std::nullopt;
    const Frame& found = **frame;
    if (found.command) {
      if (auto ok = onCommand(found.body); !ok) return tl::make_unexpected(ok.error());
      continue;
    }
    if (state_ != State::Open) return refuse("it sends messages before its READY");
    if (found.more) return refuse("it sends a message of several parts, one is allowed");
    return found.body;
  }
}

Result<bool> ZmtpPeer::readGreeting() {
  const auto byte = [this](std::size_t i) { return static_cast<std::uint8_t>(in_[i]); };
  if ((!in_.empty() && byte(0) != 0xFF) || (in_.size() > 9 && (byte(9) & 1u) == 0) ||
      (in_.size() > 10 && byte(10) < 3)) {
    return refuse("it does not speak ZMTP 3");
  }
  if (in_.size() < kGreetingBytes) return false;
  if (std::string_view(in_).substr(12, kMechanism.size()) != kMechanism)
    return refuse("it asks for another security mechanism than NULL");
  at_ = kGreetingBytes;
  state_ = State::Handshake;
  const char* type = kind_ == ZmtpKind::Router ? "ROUTER" : "XPUB";
  putCommand(out_, "READY", property("Socket-Type", type) + property("Identity", ""));
  return true;
}

Result<std::optional<ZmtpPeer::Frame>> ZmtpPeer::readFrame() {
  const std::string_view rest = std::string_view(in_).substr(at_);
  if (rest.size() < 2) return std::nullopt;
  const auto flags = static_cast<std::uint8_t>(rest[0]);
  if ((flags & ~(kMore | kLong | kCommand)) != 0) return refuse("it sends a frame of unknown kind");
  const std::size_t header = (flags & kLong) != 0 ? 9 : 2;
  if (rest.size() < header) return std::nullopt;
  const std::uint64_t size = number(rest.substr(1), header - 1);
  const bool command = (flags & kCommand) != 0;
  const std::size_t limit = command ? kMaxCommandBytes : max_message_bytes_;
  if (size > limit) {
    return refuse(fmt::format("it announces a message of {} bytes, {} are the limit", size, limit));
  }
  if (rest.size() < header + size) return std::nullopt;
  at_ += header + size;
  return Frame{(flags & kMore) != 0, command, rest.substr(header, size)};
}

Result<void> ZmtpPeer::onCommand(std::string_view body) {
  const std::size_t name_size = body.empty() ? 0 : static_cast<std::uint8_t>(body[0]);
  if (name_size == 0 || body.size() < 1 + name_size) return refuse("it sends a command of no name");
  const std::string_view name = body.substr(1, name_size);
  const std::string_view data = body.substr(1 + name_size);
  if (state_ == State::Handshake) {
    if (name != "READY") return refuse("it does not begin with READY");
    return onReady(data);
  }
  // Two bytes of time to live, then a context that comes back. An answer waits at a time.
  if (name == "PING" && data.size() >= 2 && out_.empty())
    putCommand(out_, "PONG", data.substr(2, kMaxPingContext));
  return {};
}

Result<void> ZmtpPeer::onReady(std::string_view properties) {
  const std::string_view type = propertyOf(properties, "Socket-Type").value_or("");
  const bool fits = kind_ == ZmtpKind::Router
                        ? type == "DEALER" || type == "REQ" || type == "ROUTER"
                        : type == "SUB" || type == "XSUB";
  if (!fits) return refuse("its kind of socket does not fit");
  state_ = State::Open;
  return {};
}

}  // namespace kiln
