#pragma once

#include "robot/drivers/velodyne/link/packet_file.h"

namespace kiln::velodyne {

/// The UDP packets of a capture, IPv4 fragments joined; frames that carry none are passed over.
/// Error: see openPacketFile.
[[nodiscard]] Result<std::unique_ptr<PacketFile>> openPcapFile(const std::string& path);

}  // namespace kiln::velodyne
