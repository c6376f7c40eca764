#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "robot/drivers/velodyne/codec/position_packet.h"
#include "robot/drivers/velodyne/device/capture_check.h"
#include "robot/drivers/velodyne/link/udp_frame.h"
#include "tests/fuzz/mutator.h"
#include "tests/support/data_dir.h"

namespace kiln::velodyne {
namespace {

using fuzz::Bytes;
using fuzz::Mutator;

Bytes goodPacket(ReturnMode mode) {
  Vlp16Packet packet;
  packet.mode = mode;
  packet.timestamp_us = 123456;
  for (std::size_t b = 0; b < kBlocks; ++b) {
    packet.blocks[b].azimuth =
        static_cast<std::uint16_t>(40 * (mode == ReturnMode::Dual ? b / 2 : b));
    for (std::size_t k = 0; k < 32; ++k)
      packet.blocks[b].returns[k] = {static_cast<std::uint16_t>(300 * b + k), 9};
  }
  const auto bytes = encodeVlp16Packet(packet);
  return {bytes.begin(), bytes.end()};
}

/// What must hold for anything that was accepted.
void expectSane(const PointCloud& cloud) {
  ASSERT_EQ(cloud.y.size(), cloud.x.size());
  ASSERT_EQ(cloud.time_offset_s.size(), cloud.x.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_TRUE(std::isfinite(cloud.x[i]) && std::isfinite(cloud.y[i]) &&
                std::isfinite(cloud.z[i]));
    ASSERT_LT(std::hypot(cloud.x[i], cloud.y[i]), 132.0);
    ASSERT_LT(cloud.ring[i], 16);
  }
}

TEST(FuzzVelodyne, MutatedPacketsNeverCrashTheAssembler) {
  Mutator mutator(1);
  ScanAssembler assembler({});
  std::uint64_t accepted = 0;
  for (int i = 0; i < 60000; ++i) {
    const ReturnMode mode = i % 3 == 0 ? ReturnMode::Dual : ReturnMode::Strongest;
    const auto cloud = assembler.feed(mutator.mutate(goodPacket(mode)),
                                      Stamp{std::chrono::microseconds(1327 * i)});
    if (!cloud) {
      ASSERT_FALSE(cloud.error().message.empty());
      continue;
    }
    ++accepted;
    if (*cloud != nullptr) expectSane(**cloud);
  }
  EXPECT_GT(accepted, 1000u);  // else only the first check was fuzzed
  EXPECT_GT(assembler.statistics().refused, 1000u);
}

TEST(FuzzVelodyne, PacketsWithRandomContentNeverCrashTheAssembler) {
  Mutator mutator(2);
  ScanAssembler assembler({});
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes = mutator.random(kDataPacketBytes);
    if (i % 4 != 0) {  // sound frame, random azimuths, distances and times
      for (std::size_t b = 0; b < kBlocks; ++b) {
        bytes[100 * b] = 0xFF;
        bytes[100 * b + 1] = 0xEE;
        bytes[100 * b + 3] = static_cast<std::uint8_t>(bytes[100 * b + 3] % 0x8C);
      }
      bytes[1203] = static_cast<std::uint8_t>(bytes[1203] % 0xD6);
      bytes[1204] = static_cast<std::uint8_t>(0x37 + i % 2);
      bytes[1205] = 0x22;
    }
    const auto cloud = assembler.feed(bytes, Stamp{std::chrono::microseconds(1327 * i)});
    EXPECT_EQ(cloud.has_value(), i % 4 != 0);
    if (cloud && *cloud != nullptr) expectSane(**cloud);
  }
}

TEST(FuzzVelodyne, PositionPacketsAndFrames) {
  Mutator mutator(3);
  const std::string nmea =
      "$GPRMC,081802.00,A,3649.7478558,N,00224.4542928,W,0.034,212.5,210116,0.0,E,A*2E\r\n";
  Bytes good(kPositionPacketBytes, 0);
  std::copy(nmea.begin(), nmea.end(), good.begin() + 206);
  Bytes frame(42, 0);
  frame[12] = 0x08;
  frame[14] = 0x45;
  frame[23] = 17;
  frame[16] = 2;
  frame[17] = 28;
  frame[38] = 2;
  frame[39] = 8;
  frame.insert(frame.end(), good.begin(), good.end());
  const auto datagramOf = [](LinkType link, const Bytes& bytes) -> std::optional<UdpDatagram> {
    const auto packet = ipv4PacketOf(link, bytes, bytes.size());
    return packet ? udpDatagramOf(*packet) : std::nullopt;
  };
  ASSERT_TRUE(datagramOf(LinkType::Ethernet, frame).has_value());
  for (int i = 0; i < 60000; ++i) {
    (void)parsePositionPacket(mutator.mutate(good));
    const Bytes bad = mutator.mutate(frame);
    for (const LinkType link :
         {LinkType::Ethernet, LinkType::RawIp, LinkType::LinuxCooked, LinkType::LinuxCooked2}) {
      if (const auto udp = datagramOf(link, bad)) {
        ASSERT_GE(udp->payload.data(), bad.data());
        ASSERT_LE(udp->payload.data() + udp->payload.size(), bad.data() + bad.size());
      }
    }
  }
}

class FuzzFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() / ("kiln_fuzz_" + std::to_string(::getpid()));
  }
  void TearDown() override { std::filesystem::remove(path_); }
  void check(const Bytes& bytes) {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    auto file = openPacketFile(path_.string());
    if (!file) {
      ASSERT_FALSE(file.error().message.empty());
      return;
    }
    const auto summary = checkCapture(**file, {});
    if (!summary) {
      ASSERT_NE(summary.error().message.find(path_.string()), std::string::npos) << summary.error();
    }
  }
  std::filesystem::path path_;
};

TEST_F(FuzzFiles, SyntheticPcap) {
  // Header of a microsecond Ethernet capture and three frames.
  Bytes good{0xD4, 0xC3, 0xB2, 0xA1, 2,    0,    4, 0, 0, 0, 0, 0,
             0,    0,    0,    0,    0xFF, 0xFF, 0, 0, 1, 0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    Bytes frame(42, 0);
    frame[12] = 0x08;
    frame[14] = 0x45;
    frame[16] = 0x04;  // 1234 bytes in all
    frame[17] = 0xD2;
    frame[23] = 17;
    frame[36] = 0x09;  // port 2368
    frame[37] = 0x40;
    frame[38] = 0x04;
    frame[39] = 0xBE;
    const Bytes payload = goodPacket(ReturnMode::Strongest);
    frame.insert(frame.end(), payload.begin(), payload.end());
    const auto n = static_cast<std::uint8_t>(frame.size() & 0xFF),
               m = static_cast<std::uint8_t>(frame.size() >> 8);
    good.insert(good.end(),
                {1, 0, 0, 0, static_cast<std::uint8_t>(i), 0, 0, 0, n, m, 0, 0, n, m, 0, 0});
    good.insert(good.end(), frame.begin(), frame.end());
  }
  Mutator mutator(4);
  for (int i = 0; i < 1500; ++i) check(mutator.mutate(good));
}

TEST_F(FuzzFiles, RealCaptures) {
  const auto pcap = kiln::testing::dataFile("mrpt_velodyne/sample_velodyne_vlp16_gps.pcap");
  const auto raw = kiln::testing::dataFile("nebula_vlp16/packets_1206.bin");
  if (!pcap || !raw) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  Mutator mutator(5);
  for (const auto& path : {*pcap, *raw}) {
    std::ifstream in(path, std::ios::binary);
    const Bytes good{std::istreambuf_iterator<char>(in), {}};
    for (int i = 0; i < 60; ++i) check(mutator.mutate(good));
  }
}

}  // namespace
}  // namespace kiln::velodyne
