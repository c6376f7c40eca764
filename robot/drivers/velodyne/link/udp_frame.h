#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace kiln::velodyne {

/// Link-layer header types of a capture (the numbers of the pcap file format).
enum class LinkType : int { Ethernet = 1, RawIp = 101, LinuxCooked = 113 };

/// A view into a captured frame.
struct UdpDatagram {
  std::uint16_t destination_port = 0;
  std::span<const std::uint8_t> payload;
};

/// The UDP payload of a captured frame (IPv4, VLAN tags skipped), bounds-checked.
/// @return nullopt for anything else: other protocols, fragments, lengths that do not fit the
/// frame.
[[nodiscard]] std::optional<UdpDatagram> udpDatagramOf(LinkType link,
                                                       std::span<const std::uint8_t> frame);

}  // namespace kiln::velodyne
