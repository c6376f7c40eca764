#pragma once

#include "robot/drivers/velodyne/link/packet_file.h"

namespace kiln::velodyne {

/// A capture as tcpdump and Wireshark write it (pcap or pcapng, either byte order), through
/// libpcap. Frames that carry no UDP are passed over. Error: see openPacketFile.
[[nodiscard]] Result<std::unique_ptr<PacketFile>> openPcapFile(const std::string& path);

}  // namespace kiln::velodyne
