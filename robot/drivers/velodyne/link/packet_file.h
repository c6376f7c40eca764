#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/error.h"
#include "common/core/stamp.h"

namespace kiln::velodyne {

inline constexpr std::uint16_t kDataPort = 2368;
inline constexpr std::uint16_t kPositionPort = 8308;

/// One UDP payload out of a recording.
struct RecordedPacket {
  Duration time{};                 ///< since the first packet of the file
  std::uint16_t port = kDataPort;  ///< destination
  std::vector<std::uint8_t> payload;
};

/// A recording of a LiDAR's packets, read from front to back.
class PacketFile {
 public:
  virtual ~PacketFile() = default;
  /// The next UDP packet; nullopt at the end. Error: Truncated or InvalidInput with file, packet
  /// number and offset; every further call repeats it.
  [[nodiscard]] virtual Result<std::optional<RecordedPacket>> next() = 0;
  /// Back to the first packet. Error: Storage if the file cannot be read again.
  virtual Result<void> rewind() = 0;
  [[nodiscard]] virtual const std::string& path() const = 0;
};

/// Opens a pcap capture (Ethernet, Linux cooked or raw IP link type) or a file of concatenated
/// 1206-byte data packets; told apart by their first bytes. Error: NotFound, Truncated (empty or
/// cut off) or InvalidInput (neither kind), in one sentence.
[[nodiscard]] Result<std::unique_ptr<PacketFile>> openPacketFile(const std::string& path);

}  // namespace kiln::velodyne
