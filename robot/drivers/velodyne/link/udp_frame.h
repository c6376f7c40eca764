#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

namespace kiln::velodyne {

/// Link-layer header types of a capture (the numbers of the pcap file format).
enum class LinkType : int {
  Ethernet = 1,
  RawIp = 101,
  LinuxCooked = 113,
  Ipv4 = 228,
  LinuxCooked2 = 276  ///< what `tcpdump -i any` writes
};
/// One of the above.
[[nodiscard]] bool isReadable(LinkType link);

/// An IPv4 packet, or a piece of one, in a captured frame.
struct Ipv4Packet {
  std::uint32_t source = 0, destination = 0;
  std::uint16_t id = 0;
  std::uint8_t protocol = 0;
  std::size_t offset = 0;                 ///< of a fragment in the whole, bytes
  bool more = false;                      ///< fragments follow
  std::size_t missing = 0;                ///< bytes at the end that the capture left out
  std::span<const std::uint8_t> payload;  ///< behind the IP header; a view into the frame
  [[nodiscard]] bool fragment() const { return more || offset != 0; }
};

struct UdpDatagram {
  std::uint16_t destination_port = 0;
  std::size_t missing = 0;                ///< bytes at its end that the capture left out
  std::span<const std::uint8_t> payload;  ///< a view into the packet
};

/// The IPv4 packet of a captured frame (VLAN tags skipped), bounds-checked.
/// @param wire_bytes  length of the frame before the capture's snap length cut it.
/// @return nullopt for anything else and for lengths that do not fit the frame.
[[nodiscard]] std::optional<Ipv4Packet> ipv4PacketOf(LinkType link,
                                                     std::span<const std::uint8_t> frame,
                                                     std::size_t wire_bytes);
/// The datagram in a whole UDP packet; nullopt for other protocols, fragments and wrong lengths.
[[nodiscard]] std::optional<UdpDatagram> udpDatagramOf(const Ipv4Packet& packet);

/// Joins the fragments of IPv4 packets, a few at a time: what stays incomplete is given up.
/// Thread-compatible.
class FragmentJoiner {
 public:
  /// Bytes of the whole packet behind its IP header when `piece` was the last that was missing.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> add(const Ipv4Packet& piece);
  /// Packets of which pieces are missing.
  [[nodiscard]] std::uint64_t incomplete() const { return given_up_ + open_.size(); }

 private:
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint16_t, std::uint8_t>;
  struct Open {
    std::uint64_t age = 0;  ///< number of its first piece
    std::vector<std::uint8_t> bytes;
    std::vector<bool> have;  ///< by units of 8 bytes
    std::optional<std::size_t> size;
  };
  void giveUpOldest();

  std::map<Key, Open> open_;
  std::uint64_t pieces_ = 0, given_up_ = 0;
};

}  // namespace kiln::velodyne
