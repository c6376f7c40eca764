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
  Duration time{};                 ///< by the capture's clock, since the first packet of the file;
                                   ///< zero where there is none
  std::uint32_t source = 0;        ///< IPv4 address of the sender; 0: not known
  std::uint16_t port = kDataPort;  ///< destination
  std::size_t missing = 0;         ///< bytes at its end that the capture's snap length left out
  std::vector<std::uint8_t> payload;
};

/// What of a recording could not be read as UDP since its beginning.
struct LinkCounts {
  std::uint64_t incomplete = 0;   ///< packets of which IPv4 fragments are missing
  std::uint64_t other_links = 0;  ///< frames of a link type that is not read
  int other_link = 0;             ///< such a type
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
  [[nodiscard]] virtual LinkCounts counts() const { return {}; }
};

/// Opens a capture (pcap or pcapng; Ethernet, Linux cooked or raw IP frames) or a file of
/// concatenated 1206-byte data packets; told apart by their first bytes. Error: NotFound, Truncated
/// (empty or cut off) or InvalidInput (neither kind, or compressed), in one sentence.
[[nodiscard]] Result<std::unique_ptr<PacketFile>> openPacketFile(const std::string& path);

}  // namespace kiln::velodyne
