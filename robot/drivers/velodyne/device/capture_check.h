#pragma once

#include "robot/drivers/velodyne/codec/position_packet.h"
#include "robot/drivers/velodyne/codec/scan_assembler.h"
#include "robot/drivers/velodyne/link/packet_file.h"

namespace kiln::velodyne {

/// What a recording holds.
struct CaptureSummary {
  std::uint64_t data_packets = 0;
  std::uint64_t position_packets = 0;
  std::uint64_t other_packets = 0;  ///< UDP to other ports
  ScanStatistics scan;
  ReturnMode mode = ReturnMode::Strongest;  ///< of the first packet
  std::optional<PositionPacket> position;   ///< the last one
  Duration length{};
};

/// Reads the whole file once and leaves it at its start. Error: the file's own (cut off), the first
/// bad data packet's with file and packet number (e.g. another sensor model), or Degenerate if
/// there is no data packet or not one full revolution.
[[nodiscard]] Result<CaptureSummary> checkCapture(PacketFile& file,
                                                  const ScanAssembler::Config& config);

}  // namespace kiln::velodyne
