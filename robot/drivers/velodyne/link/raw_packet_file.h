#pragma once

#include "robot/drivers/velodyne/link/packet_file.h"

namespace kiln::velodyne {

/// Data packets of 1206 bytes one after the other, without any header. What stands between two
/// packets comes as a packet of its own length, for the reader to refuse. Error: see
/// openPacketFile.
[[nodiscard]] Result<std::unique_ptr<PacketFile>> openRawPacketFile(const std::string& path);

}  // namespace kiln::velodyne
