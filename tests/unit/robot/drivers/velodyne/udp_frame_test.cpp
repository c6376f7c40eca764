#include "robot/drivers/velodyne/link/udp_frame.h"

#include <vector>

#include <gtest/gtest.h>

namespace kiln::velodyne {
namespace {

/// Ethernet, IPv4 without options, UDP to `port`.
std::vector<std::uint8_t> frameTo(std::uint16_t port, const std::vector<std::uint8_t>& payload,
                                  bool vlan = false) {
  std::vector<std::uint8_t> out(12, 0xFF);
  if (vlan) out.insert(out.end(), {0x81, 0x00, 0x00, 0x05});
  out.insert(out.end(), {0x08, 0x00});
  const std::size_t total = 28 + payload.size(), udp = 8 + payload.size();
  out.insert(out.end(), {0x45,
                         0,
                         static_cast<std::uint8_t>(total >> 8),
                         static_cast<std::uint8_t>(total),
                         0,
                         0,
                         0x40,
                         0,
                         64,
                         17,
                         0,
                         0,
                         192,
                         168,
                         1,
                         201,
                         255,
                         255,
                         255,
                         255});
  out.insert(out.end(),
             {0x09, 0x40, static_cast<std::uint8_t>(port >> 8), static_cast<std::uint8_t>(port),
              static_cast<std::uint8_t>(udp >> 8), static_cast<std::uint8_t>(udp), 0, 0});
  out.insert(out.end(), payload.begin(), payload.end());
  return out;
}

TEST(UdpFrame, FindsThePayload) {
  for (const bool vlan : {false, true}) {
    const auto frame = frameTo(2368, {1, 2, 3, 4}, vlan);
    const auto udp = udpDatagramOf(LinkType::Ethernet, frame);
    ASSERT_TRUE(udp.has_value());
    EXPECT_EQ(udp->destination_port, 2368);
    EXPECT_EQ(std::vector<std::uint8_t>(udp->payload.begin(), udp->payload.end()),
              (std::vector<std::uint8_t>{1, 2, 3, 4}));
  }
}

TEST(UdpFrame, IgnoresEthernetPadding) {
  auto frame = frameTo(2368, {9});
  frame.resize(60, 0);
  EXPECT_EQ(udpDatagramOf(LinkType::Ethernet, frame)->payload.size(), 1u);
}

TEST(UdpFrame, RefusesEveryTruncation) {
  const auto frame = frameTo(2368, {1, 2, 3, 4}, true);
  for (std::size_t n = 0; n < frame.size(); ++n) {
    EXPECT_FALSE(udpDatagramOf(LinkType::Ethernet, std::span(frame).first(n)).has_value()) << n;
  }
}

TEST(UdpFrame, RefusesFragmentsAndOtherProtocols) {
  auto fragment = frameTo(2368, {1});
  fragment[20] = 0x20;  // more fragments
  EXPECT_FALSE(udpDatagramOf(LinkType::Ethernet, fragment).has_value());
  auto tcp = frameTo(2368, {1});
  tcp[23] = 6;
  EXPECT_FALSE(udpDatagramOf(LinkType::Ethernet, tcp).has_value());
  auto ipv6 = frameTo(2368, {1});
  ipv6[14] = 0x65;
  EXPECT_FALSE(udpDatagramOf(LinkType::Ethernet, ipv6).has_value());
}

}  // namespace
}  // namespace kiln::velodyne
