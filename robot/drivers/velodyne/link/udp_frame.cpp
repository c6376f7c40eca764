#include "robot/drivers/velodyne/link/udp_frame.h"

namespace kiln::velodyne {
namespace {

constexpr std::uint16_t kEtherIpv4 = 0x0800, kEtherVlan = 0x8100, kEtherServiceVlan = 0x88A8;
constexpr std::uint8_t kProtocolUdp = 17;
constexpr std::size_t kUdpHeader = 8;

std::uint16_t be16(std::span<const std::uint8_t> b, std::size_t at) {
  return static_cast<std::uint16_t>(b[at] << 8 | b[at + 1]);
}

std::optional<std::span<const std::uint8_t>> ipv4Of(LinkType link,
                                                    std::span<const std::uint8_t> frame) {
  if (link == LinkType::RawIp) return frame;
  std::size_t type_at = link == LinkType::Ethernet ? 12 : 14;
  while (frame.size() >= type_at + 2) {
    const std::uint16_t type = be16(frame, type_at);
    if (type == kEtherIpv4) return frame.subspan(type_at + 2);
    if (type != kEtherVlan && type != kEtherServiceVlan) return std::nullopt;
    type_at += 4;
  }
  return std::nullopt;
}

}  // namespace

std::optional<UdpDatagram> udpDatagramOf(LinkType link, std::span<const std::uint8_t> frame) {
  const auto ip = ipv4Of(link, frame);
  if (!ip || ip->size() < 20 || ((*ip)[0] >> 4) != 4) return std::nullopt;
  const std::size_t header = static_cast<std::size_t>((*ip)[0] & 0x0F) * 4;
  const std::size_t total = be16(*ip, 2);
  const bool fragment = (be16(*ip, 6) & 0x3FFF) != 0;  // "more fragments" flag or an offset
  if (header < 20 || total < header + kUdpHeader || total > ip->size() || fragment ||
      (*ip)[9] != kProtocolUdp) {
    return std::nullopt;
  }
  const auto udp = ip->subspan(header, total - header);
  const std::size_t length = be16(udp, 4);
  if (length < kUdpHeader || length > udp.size()) return std::nullopt;
  return UdpDatagram{be16(udp, 2), udp.subspan(kUdpHeader, length - kUdpHeader)};
}

}  // namespace kiln::velodyne
