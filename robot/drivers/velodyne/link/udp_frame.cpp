#include "robot/drivers/velodyne/link/udp_frame.h"

#include <algorithm>

namespace kiln::velodyne {
namespace {

constexpr std::uint16_t kEtherIpv4 = 0x0800, kEtherVlan = 0x8100, kEtherServiceVlan = 0x88A8;
constexpr std::uint8_t kProtocolUdp = 17;
constexpr std::size_t kUdpHeader = 8;
constexpr std::size_t kFragmentUnit = 8;
constexpr std::size_t kOpenPackets = 16;

std::uint16_t be16(std::span<const std::uint8_t> b, std::size_t at) {
  return static_cast<std::uint16_t>(b[at] << 8 | b[at + 1]);
}
std::uint32_t be32(std::span<const std::uint8_t> b, std::size_t at) {
  return static_cast<std::uint32_t>(be16(b, at)) << 16 | be16(b, at + 2);
}

/// Where a link header says what follows, and where that begins.
struct LinkHeader {
  std::size_t type_at, bytes;
};
LinkHeader headerOf(LinkType link) {
  if (link == LinkType::LinuxCooked) return {14, 16};
  if (link == LinkType::LinuxCooked2) return {0, 20};
  return {12, 14};
}

std::optional<std::span<const std::uint8_t>> ipv4Of(LinkType link,
                                                    std::span<const std::uint8_t> frame) {
  if (link == LinkType::RawIp || link == LinkType::Ipv4) return frame;
  const LinkHeader header = headerOf(link);
  if (frame.size() < header.bytes) return std::nullopt;
  std::uint16_t type = be16(frame, header.type_at);
  auto rest = frame.subspan(header.bytes);
  while ((type == kEtherVlan || type == kEtherServiceVlan) && rest.size() >= 4) {
    type = be16(rest, 2);
    rest = rest.subspan(4);
  }
  if (type != kEtherIpv4) return std::nullopt;
  return rest;
}

}  // namespace

bool isReadable(LinkType link) {
  switch (link) {
    case LinkType::Ethernet:
    case LinkType::RawIp:
    case LinkType::LinuxCooked:
    case LinkType::Ipv4:
    case LinkType::LinuxCooked2:
      return true;
  }
  return false;
}

std::optional<Ipv4Packet> ipv4PacketOf(LinkType link, std::span<const std::uint8_t> frame,
                                       std::size_t wire_bytes) {
  const auto ip = ipv4Of(link, frame);
  if (!ip || ip->size() < 20 || ((*ip)[0] >> 4) != 4) return std::nullopt;
  const std::size_t header = static_cast<std::size_t>((*ip)[0] & 0x0F) * 4;
  const std::size_t total = be16(*ip, 2);
  if (header < 20 || total < header || ip->size() < header) return std::nullopt;
  const std::size_t missing = total - std::min(total, ip->size());
  if (missing > wire_bytes - std::min(wire_bytes, frame.size())) return std::nullopt;
  Ipv4Packet out;
  out.id = be16(*ip, 4);
  out.offset = static_cast<std::size_t>(be16(*ip, 6) & 0x1FFF) * kFragmentUnit;
  out.more = (be16(*ip, 6) & 0x2000) != 0;
  out.protocol = (*ip)[9];
  out.source = be32(*ip, 12);
  out.destination = be32(*ip, 16);
  out.missing = missing;
  out.payload = ip->subspan(header, total - missing - header);
  return out;
}

std::optional<UdpDatagram> udpDatagramOf(const Ipv4Packet& packet) {
  if (packet.protocol != kProtocolUdp || packet.fragment() || packet.payload.size() < kUdpHeader)
    return std::nullopt;
  const std::size_t length = be16(packet.payload, 4);
  if (length < kUdpHeader || length > packet.payload.size() + packet.missing) return std::nullopt;
  const std::size_t here = std::min(length, packet.payload.size());
  return UdpDatagram{be16(packet.payload, 2), length - here,
                     packet.payload.subspan(kUdpHeader, here - kUdpHeader)};
}

std::optional<std::vector<std::uint8_t>> FragmentJoiner::add(const Ipv4Packet& piece) {
  constexpr std::size_t kLargest = 65535;
  const std::size_t end = piece.offset + piece.payload.size();
  if (piece.missing > 0 || end > kLargest) return std::nullopt;
  ++pieces_;
  const Key key{piece.source, piece.destination, piece.id, piece.protocol};
  if (!open_.contains(key) && open_.size() >= kOpenPackets) giveUpOldest();
  Open& open = open_.try_emplace(key, Open{pieces_, {}, {}, {}}).first->second;
  if (open.bytes.size() < end) {
    open.bytes.resize(end);
    open.have.resize((end + kFragmentUnit - 1) / kFragmentUnit);
  }
  std::copy(piece.payload.begin(), piece.payload.end(),
            open.bytes.begin() + static_cast<std::ptrdiff_t>(piece.offset));
  for (std::size_t at = piece.offset; at < end; at += kFragmentUnit)
    open.have[at / kFragmentUnit] = true;
  if (!piece.more) open.size = end;
  const bool whole = open.size == open.bytes.size() &&
                     std::find(open.have.begin(), open.have.end(), false) == open.have.end();
  if (!whole) return std::nullopt;
  auto bytes = std::move(open.bytes);
  open_.erase(key);
  return bytes;
}

void FragmentJoiner::giveUpOldest() {
  ++given_up_;
  open_.erase(std::min_element(open_.begin(), open_.end(), [](const auto& a, const auto& b) {
    return a.second.age < b.second.age;
  }));
}

}  // namespace kiln::velodyne
