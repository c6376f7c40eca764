#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "common/core/error.h"

namespace kiln::velodyne {

/// One frame of a capture.
struct CapturedFrame {
  std::uint64_t number = 0;    ///< from 1
  std::int64_t time_ns = 0;    ///< by the capture's clock
  int link = 0;                ///< LinkType, or one that is not read
  std::size_t wire_bytes = 0;  ///< before the snap length cut it
  std::vector<std::uint8_t> bytes;
};

/// A capture as tcpdump and Wireshark write it: pcap or pcapng, either byte order, any link types
/// beside each other. Read from front to back.
class FrameFile {
 public:
  explicit FrameFile(std::string path) : path_(std::move(path)) {}
  /// To the first frame. Error: InvalidInput, no capture starts there.
  [[nodiscard]] Result<void> open();
  /// nullopt at the end. Error: Truncated with frame number and offset.
  [[nodiscard]] Result<std::optional<CapturedFrame>> next();
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  struct Interface {
    int link = 0;
    std::size_t snap_length = 0;  ///< 0: none
    std::uint64_t ticks_per_s = 1'000'000;
    std::int64_t offset_s = 0;
  };
  struct Block {
    std::uint32_t type = 0;
    std::vector<std::uint8_t> body;
  };
  [[nodiscard]] Result<std::optional<CapturedFrame>> nextPcap();
  [[nodiscard]] Result<std::optional<CapturedFrame>> nextPcapng();
  [[nodiscard]] Result<std::optional<Block>> nextBlock();
  [[nodiscard]] Result<void> beginSection(const std::vector<std::uint8_t>& head);
  [[nodiscard]] Result<void> addInterface(const std::vector<std::uint8_t>& body);
  [[nodiscard]] Result<CapturedFrame> frameOf(const Block& block);
  [[nodiscard]] bool read(std::vector<std::uint8_t>& out, std::size_t bytes);
  [[nodiscard]] std::uint64_t number(const std::vector<std::uint8_t>& from, std::size_t at,
                                     std::size_t bytes) const;
  [[nodiscard]] tl::unexpected<Error> damaged(const char* why) const;

  std::string path_;
  std::ifstream in_;
  std::uint64_t size_ = 0, at_ = 0;  ///< bytes of the file; where the record in hand begins
  bool pcapng_ = false, big_endian_ = false;
  std::uint64_t frames_ = 0;
  std::vector<Interface> interfaces_;  ///< of the section; one for pcap
};

}  // namespace kiln::velodyne
