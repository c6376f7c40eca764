#include "robot/drivers/velodyne/codec/vlp16_packet.h"

#include <gmock/gmock.h>

#include "tests/support/synthetic_packets.h"

namespace kiln::velodyne {
namespace {

using ::testing::HasSubstr;

std::array<std::uint8_t, kDataPacketBytes> goodBytes(ReturnMode mode = ReturnMode::Strongest) {
  testing::SyntheticSensor sensor;
  sensor.mode = mode;
  return encodeVlp16Packet(sensor.next());
}

TEST(Vlp16Packet, ParsesWhatItEncoded) {
  for (const ReturnMode mode : {ReturnMode::Strongest, ReturnMode::Last, ReturnMode::Dual}) {
    const auto bytes = goodBytes(mode);
    const auto packet = parseVlp16Packet(bytes);
    ASSERT_TRUE(packet.has_value()) << packet.error();
    EXPECT_EQ(packet->mode, mode);
    EXPECT_EQ(encodeVlp16Packet(*packet), bytes);
  }
}

TEST(Vlp16Packet, NamesTheOtherSensor) {
  auto bytes = goodBytes();
  bytes[1205] = 0x21;
  const auto packet = parseVlp16Packet(bytes);
  ASSERT_FALSE(packet.has_value());
  EXPECT_EQ(packet.error().message,
            "packet is from an HDL-32E (product 0x21); this input needs a VLP-16");
  EXPECT_EQ(packet.error().code, ErrorCode::VersionMismatch);
}

struct Damage {
  std::size_t at;
  std::uint8_t value;
  const char* said;
};
class DamagedPacket : public ::testing::TestWithParam<Damage> {};

TEST_P(DamagedPacket, IsRefusedWithTheReason) {
  auto bytes = goodBytes(ReturnMode::Dual);
  bytes[GetParam().at] = GetParam().value;
  const auto packet = parseVlp16Packet(bytes);
  ASSERT_FALSE(packet.has_value());
  EXPECT_THAT(packet.error().message, HasSubstr(GetParam().said));
}
INSTANTIATE_TEST_SUITE_P(Each, DamagedPacket,
                         ::testing::Values(Damage{0, 0x00, "block 0 starts with 00 EE"},
                                           Damage{1101, 0xDD, "block 11 starts with FF DD"},
                                           Damage{503, 0x8D,
                                                  "block 5 has azimuth"},  // >= 0x8D00 = 360.96 deg
                                           Damage{1203, 0xFF, "us after the hour"},
                                           Damage{1204, 0x36, "return mode 0x36"},
                                           Damage{1205, 0x77, "an unknown sensor (product 0x77)"},
                                           Damage{102, 0x07, "must be equal"}));

TEST(Vlp16Packet, RefusesEveryOtherSize) {
  const auto bytes = goodBytes();
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1205}}) {
    EXPECT_FALSE(parseVlp16Packet(std::span(bytes).first(size)).has_value()) << size;
  }
  std::vector<std::uint8_t> longer(bytes.begin(), bytes.end());
  longer.push_back(0);
  EXPECT_FALSE(parseVlp16Packet(longer).has_value());
}

}  // namespace
}  // namespace kiln::velodyne
