#include "robot/drivers/velodyne/link/udp_frame.h"

#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/capture_builder.h"

namespace kiln::velodyne {
namespace {

using kiln::testing::Bytes;

/// Ethernet, IPv4 without options, UDP to `port`.
Bytes frameTo(std::uint16_t port, const Bytes& payload, bool vlan = false) {
  const kiln::testing::Sender from{201, port};
  Bytes out = kiln::testing::linkFrame(
      LinkType::Ethernet, kiln::testing::ipv4(from, kiln::testing::udp(from, payload)));
  const Bytes tag{0x81, 0x00, 0x00, 0x05};
  if (vlan) out.insert(out.begin() + 12, tag.begin(), tag.end());
  return out;
}

std::optional<UdpDatagram> datagramOf(LinkType link, std::span<const std::uint8_t> frame) {
  const auto packet = ipv4PacketOf(link, frame, frame.size());
  return packet ? udpDatagramOf(*packet) : std::nullopt;
}

TEST(UdpFrame, FindsThePayload) {
  for (const bool vlan : {false, true}) {
    const auto frame = frameTo(2368, {1, 2, 3, 4}, vlan);
    const auto udp = datagramOf(LinkType::Ethernet, frame);
    ASSERT_TRUE(udp.has_value());
    EXPECT_EQ(udp->destination_port, 2368);
    EXPECT_EQ(std::vector<std::uint8_t>(udp->payload.begin(), udp->payload.end()),
              (std::vector<std::uint8_t>{1, 2, 3, 4}));
  }
}

TEST(UdpFrame, IgnoresEthernetPadding) {
  auto frame = frameTo(2368, {9});
  frame.resize(60, 0);
  EXPECT_EQ(datagramOf(LinkType::Ethernet, frame)->payload.size(), 1u);
}

TEST(UdpFrame, RefusesEveryTruncation) {
  const auto frame = frameTo(2368, {1, 2, 3, 4}, true);
  for (std::size_t n = 0; n < frame.size(); ++n) {
    EXPECT_FALSE(datagramOf(LinkType::Ethernet, std::span(frame).first(n)).has_value()) << n;
  }
}

TEST(UdpFrame, RefusesFragmentsAndOtherProtocols) {
  auto fragment = frameTo(2368, {1});
  fragment[20] = 0x20;  // more fragments
  EXPECT_FALSE(datagramOf(LinkType::Ethernet, fragment).has_value());
  auto tcp = frameTo(2368, {1});
  tcp[23] = 6;
  EXPECT_FALSE(datagramOf(LinkType::Ethernet, tcp).has_value());
  auto ipv6 = frameTo(2368, {1});
  ipv6[14] = 0x65;
  EXPECT_FALSE(datagramOf(LinkType::Ethernet, ipv6).has_value());
}

TEST(UdpFrame, TellsWhatTheSnapLengthTookAway) {
  const auto frame = frameTo(2368, Bytes(1206, 1));
  const auto packet = ipv4PacketOf(LinkType::Ethernet, std::span(frame).first(100), frame.size());
  ASSERT_TRUE(packet.has_value());
  const auto cut = udpDatagramOf(*packet);
  ASSERT_TRUE(cut.has_value());
  EXPECT_EQ(cut->destination_port, 2368);
  EXPECT_EQ(cut->payload.size() + cut->missing, 1206u);
  EXPECT_EQ(cut->missing, frame.size() - 100);
}

TEST(FragmentJoiner, JoinsInAnyOrderAndForgetsWhatStaysIncomplete) {
  const Bytes whole = kiln::testing::udp({}, Bytes(1206, 5));
  FragmentJoiner joiner;
  Ipv4Packet piece;
  piece.protocol = 17;
  for (std::uint16_t id = 0; id < 100; ++id) {  // of each only the end
    piece.id = id;
    piece.offset = 800;
    piece.payload = std::span(whole).subspan(800);
    EXPECT_FALSE(joiner.add(piece).has_value());
  }
  EXPECT_EQ(joiner.incomplete(), 100u);
  piece.offset = 0;
  piece.more = true;
  piece.payload = std::span(whole).first(800);
  EXPECT_EQ(joiner.add(piece), whole);  // the last of them is still known
  EXPECT_EQ(joiner.incomplete(), 99u);
  piece.id = 3;
  EXPECT_FALSE(joiner.add(piece).has_value());  // an early one no more
}

}  // namespace
}  // namespace kiln::velodyne
