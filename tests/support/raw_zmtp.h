#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/core/stamp.h"
#include "common/transport/listener.h"

namespace kiln::test {

/// A peer that speaks ZMTP over a plain socket, so that it can say what no library would. Test
/// code: nothing is checked but the connection.
class RawZmtp {
 public:
  /// @param address  tcp://HOST:PORT or ipc:///PATH; not connected() if nobody listens.
  explicit RawZmtp(const std::string& address);

  [[nodiscard]] bool connected() const { return fd_.get() >= 0; }
  /// Greeting and READY of a socket of this type.
  bool shakeHands(std::string_view socket_type, std::string_view identity = "");
  /// As it is. @return false when the other side has closed or took nothing for a second.
  bool sendRaw(std::string_view bytes);
  bool send(std::string_view message, bool more = false);
  /// The next message, its parts joined.
  [[nodiscard]] std::optional<std::string> receive(Duration limit);
  /// Whether the other side closes within `limit`; what it sends meanwhile is thrown away.
  [[nodiscard]] bool closedWithin(Duration limit);

 private:
  [[nodiscard]] bool readMore(Duration limit);
  UniqueFd fd_;
  std::string in_;
  bool closed_ = false;
};

/// One frame with its header.
[[nodiscard]] std::string zmtpFrame(std::string_view body, unsigned flags = 0);

}  // namespace kiln::test
