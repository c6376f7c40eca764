#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/error.h"
#include "common/transport/topics.h"

namespace kiln {

/// Sent before every published payload.
struct FrameHeader {
  std::uint64_t seq = 0;             ///< +1 a message of this topic: a gap is a loss on the way
  std::int64_t published_ns = 0;     ///< robot time
  std::uint64_t dropped_before = 0;  ///< dropped on the robot so far, in front of the socket
};
inline constexpr std::size_t kFrameHeaderBytes = 24;

/// Little-endian, fixed size.
[[nodiscard]] std::string encodeFrameHeader(const FrameHeader& header);
[[nodiscard]] Result<FrameHeader> decodeFrameHeader(std::string_view bytes);

/// Losses of one topic as a subscriber sees them.
class SequenceCounter {
 public:
  /// @return messages lost since the previous one. A number that went back (robot restarted) starts
  /// anew.
  std::uint64_t next(std::uint64_t seq);
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  std::uint64_t last_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace kiln
