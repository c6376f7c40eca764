#include "robot/drivers/velodyne/codec/position_packet.h"

#include <vector>

#include <gtest/gtest.h>

namespace kiln::velodyne {
namespace {

std::vector<std::uint8_t> packetWith(const std::string& nmea, std::uint8_t pps = 2) {
  std::vector<std::uint8_t> out(kPositionPacketBytes, 0);
  out[198] = 0x71;
  out[199] = 0x3A;
  out[200] = 0x83;
  out[201] = 0x40;
  out[202] = pps;
  std::copy(nmea.begin(), nmea.end(), out.begin() + 206);
  return out;
}

TEST(PositionPacket, ReadsPpsAndUtc) {
  const auto packet = parsePositionPacket(packetWith(
      "$GPRMC,081802.00,A,3649.7478558,N,00224.4542928,W,0.034,212.5,210116,0.0,E,A*2E\r\n"));
  ASSERT_TRUE(packet.has_value()) << packet.error();
  EXPECT_EQ(packet->timestamp_us, 0x40833A71u);
  EXPECT_EQ(packet->pps, PpsStatus::Locked);
  EXPECT_TRUE(packet->nmea_valid);
  ASSERT_TRUE(packet->utc_s.has_value());
  EXPECT_DOUBLE_EQ(*packet->utc_s, 8 * 3600 + 18 * 60 + 2);
}

TEST(PositionPacket, DoesNotBelieveABrokenSentence) {
  for (const char* nmea : {"", "$", "$GPRMC", "$GPRMC,081802*00", "$GPRMC,xx*", "garbage*2E"}) {
    const auto packet = parsePositionPacket(packetWith(nmea));
    ASSERT_TRUE(packet.has_value());
    EXPECT_FALSE(packet->nmea_valid) << nmea;
    EXPECT_FALSE(packet->utc_s.has_value()) << nmea;
  }
}

TEST(PositionPacket, RefusesWrongSizeAndStatus) {
  EXPECT_FALSE(parsePositionPacket(packetWith("", 4)).has_value());
  const auto packet = packetWith("");
  EXPECT_FALSE(parsePositionPacket(std::span(packet).first(511)).has_value());
}

}  // namespace
}  // namespace kiln::velodyne
