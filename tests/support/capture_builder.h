#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "robot/drivers/velodyne/link/packet_file.h"
#include "robot/drivers/velodyne/link/udp_frame.h"

namespace kiln::testing {

using Bytes = std::vector<std::uint8_t>;

/// The sender of a packet, and where it goes to.
struct Sender {
  std::uint8_t host = 201;  ///< 192.168.1.host
  std::uint16_t port = velodyne::kDataPort;
};

inline void putBig(Bytes& out, std::uint64_t value, int bytes) {
  for (int i = bytes - 1; i >= 0; --i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}
inline void putLittle(Bytes& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}
inline void append(Bytes& out, const Bytes& more) {
  out.insert(out.end(), more.begin(), more.end());
}

/// IPv4 header and `payload`. @param fragment  flags and offset word.
inline Bytes ipv4(const Sender& from, const Bytes& payload, std::uint16_t id = 0,
                  std::uint16_t fragment = 0) {
  Bytes out{0x45, 0};
  putBig(out, 20 + payload.size(), 2);
  putBig(out, id, 2);
  putBig(out, fragment, 2);
  append(out, {64, 17, 0, 0, 192, 168, 1, from.host, 255, 255, 255, 255});
  append(out, payload);
  return out;
}
inline Bytes udp(const Sender& from, const Bytes& payload) {
  Bytes out{0x09, 0x40};
  putBig(out, from.port, 2);
  putBig(out, 8 + payload.size(), 2);
  append(out, {0, 0});
  append(out, payload);
  return out;
}
/// Link header and `ip`.
inline Bytes linkFrame(velodyne::LinkType link, const Bytes& ip) {
  Bytes out;
  switch (link) {
    case velodyne::LinkType::Ethernet:
      out = Bytes(12, 0xFF);
      append(out, {0x08, 0x00});
      break;
    case velodyne::LinkType::LinuxCooked:
      out = Bytes(14, 0);
      append(out, {0x08, 0x00});
      break;
    case velodyne::LinkType::LinuxCooked2:
      out = {0x08, 0x00};
      out.resize(20);
      break;
    case velodyne::LinkType::RawIp:
    case velodyne::LinkType::Ipv4:
      break;
  }
  append(out, ip);
  return out;
}

/// Bytes of a pcap or pcapng file, frame by frame.
class CaptureBuilder {
 public:
  using LinkType = velodyne::LinkType;

  explicit CaptureBuilder(LinkType link = LinkType::Ethernet) : link_(link) {
    putLittle(bytes_, 0xA1B2C3D4, 4);
    putLittle(bytes_, 0x00040002, 4);
    putLittle(bytes_, 0, 8);
    putLittle(bytes_, 262144, 4);
    putLittle(bytes_, static_cast<std::uint64_t>(link), 4);
  }
  /// pcapng with an interface for each of `links`.
  explicit CaptureBuilder(const std::vector<LinkType>& links) : link_(links.back()), pcapng_(true) {
    Bytes head;
    putLittle(head, 0x1A2B3C4D, 4);
    putLittle(head, 1, 4);
    putLittle(head, ~std::uint64_t{0}, 8);
    block(0x0A0D0D0A, head);
    for (const LinkType link : links) {
      Bytes interface;
      putLittle(interface, static_cast<std::uint64_t>(link), 4);
      putLittle(interface, 262144, 4);
      block(1, interface);
    }
    interface_ = links.size() - 1;
  }

  void frame(std::int64_t time_us, const Bytes& frame, std::size_t snap = 262144) {
    const std::size_t here = std::min(snap, frame.size());
    Bytes head;
    if (pcapng_) {
      putLittle(head, interface_, 4);
      putLittle(head, static_cast<std::uint64_t>(time_us) >> 32, 4);
      putLittle(head, static_cast<std::uint64_t>(time_us), 4);
    } else {
      putLittle(head, static_cast<std::uint64_t>(time_us / 1'000'000), 4);
      putLittle(head, static_cast<std::uint64_t>(time_us % 1'000'000), 4);
    }
    putLittle(head, here, 4);
    putLittle(head, frame.size(), 4);
    head.insert(head.end(), frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(here));
    if (!pcapng_) return append(bytes_, head);
    head.resize((head.size() + 3) / 4 * 4);
    block(6, head);
  }
  void datagram(std::int64_t time_us, const Bytes& payload, const Sender& from = {},
                std::size_t snap = 262144) {
    frame(time_us, linkFrame(link_, ipv4(from, udp(from, payload))), snap);
  }
  /// In two IPv4 fragments, the second first; `whole` false: without the first.
  void fragments(std::int64_t time_us, const Bytes& payload, bool whole = true) {
    const Bytes datagram = udp({}, payload);
    constexpr std::ptrdiff_t kCut = 800;
    const Bytes first(datagram.begin(), datagram.begin() + kCut),
        second(datagram.begin() + kCut, datagram.end());
    ++id_;
    frame(time_us, linkFrame(link_, ipv4({}, second, id_, kCut / 8)));
    if (whole) frame(time_us, linkFrame(link_, ipv4({}, first, id_, 0x2000)));
  }
  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  void block(std::uint32_t type, const Bytes& body) {
    putLittle(bytes_, type, 4);
    putLittle(bytes_, body.size() + 12, 4);
    append(bytes_, body);
    putLittle(bytes_, body.size() + 12, 4);
  }
  LinkType link_;
  bool pcapng_ = false;
  std::size_t interface_ = 0;
  std::uint16_t id_ = 0;
  Bytes bytes_;
};

}  // namespace kiln::testing
