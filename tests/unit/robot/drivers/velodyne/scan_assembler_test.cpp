#include "robot/drivers/velodyne/codec/scan_assembler.h"

#include <gtest/gtest.h>

#include "tests/support/synthetic_packets.h"

namespace kiln::velodyne {
namespace {

using testing::SyntheticSensor;

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

PointCloudPtr feedUntilRevolution(ScanAssembler& assembler, SyntheticSensor& sensor, int& budget) {
  while (budget-- > 0) {
    const double received = sensor.time_us * 1e-6;
    auto cloud = assembler.feed(encodeVlp16Packet(sensor.next()), at(received));
    EXPECT_TRUE(cloud.has_value());
    if (cloud && *cloud != nullptr) return *cloud;
  }
  return nullptr;
}

TEST(Vlp16Decoder, PutsAPointWhereItsFiringLooked) {
  // One block at 90 deg, laser 1 (elevation +1 deg) at 2 m: sensor x = 2 cos 1 deg, so y_lidar = -2
  // cos 1 deg.
  Vlp16Packet packet;
  for (auto& block : packet.blocks) block.azimuth = 9000;
  packet.blocks[0].returns[1] = {1000, 42};
  Vlp16Decoder decoder({.vertical_correction = false});
  Decoded out;
  decoder.decode(packet, out);
  ASSERT_EQ(out.points.size(), 1u);
  EXPECT_NEAR(out.points[0].x, 0.0, 1e-4);
  EXPECT_NEAR(out.points[0].y, -1.99970, 1e-4);
  EXPECT_NEAR(out.points[0].z, 0.03490, 1e-4);
  EXPECT_EQ(out.points[0].ring, 8);
  EXPECT_EQ(out.points[0].intensity, 42);
  EXPECT_NEAR(out.points[0].time_us, 2.304, 1e-3);
}

TEST(Vlp16Decoder, RaisesEachLaserByItsOrigin) {
  Vlp16Packet packet;
  packet.blocks[0].returns[0] = {1000, 1};  // -15 deg: leaves 11.2 mm above the centre
  Decoded flat, raised;
  Vlp16Decoder({.vertical_correction = false}).decode(packet, flat);
  Vlp16Decoder({.vertical_correction = true}).decode(packet, raised);
  EXPECT_NEAR(raised.points[0].z - flat.points[0].z, 0.0112, 1e-5);
}

TEST(Vlp16Decoder, InterpolatesTheAzimuthOfEachFiring) {
  // Blocks 40 units apart; laser 15 of the second sequence fires 89.856 us of 110.592 us
  // later: 32.5 units.
  Vlp16Packet packet;
  for (std::size_t b = 0; b < kBlocks; ++b)
    packet.blocks[b].azimuth = static_cast<std::uint16_t>(100 + 40 * b);
  packet.blocks[0].returns[31] = {1000, 1};
  packet.blocks[11].returns[31] = {1000, 1};  // no successor: the previous gap again
  Vlp16Decoder decoder({});
  Decoded out;
  decoder.decode(packet, out);
  ASSERT_EQ(out.points.size(), 2u);
  EXPECT_NEAR(out.points[0].azimuth, 132.5, 1.0);
  EXPECT_NEAR(out.points[1].azimuth, 100 + 440 + 32.5, 1.0);
}

TEST(Vlp16Decoder, DropsTheSecondOfTwoEqualReturns) {
  SyntheticSensor sensor;
  sensor.mode = ReturnMode::Dual;
  Vlp16Packet packet = sensor.next();
  Vlp16Decoder decoder({});
  Decoded out;
  decoder.decode(packet, out);
  EXPECT_EQ(out.points.size(), 12u * 32u);  // twins 1 m apart: all kept
  for (std::size_t b = 0; b < kBlocks; b += 2)
    packet.blocks[b + 1].returns = packet.blocks[b].returns;
  decoder.decode(packet, out);
  EXPECT_EQ(out.points.size(), 6u * 32u);
}

TEST(ScanAssembler, DeliversFullRevolutionsCutBehindTheRobot) {
  ScanAssembler assembler({});
  SyntheticSensor sensor;
  int budget = 400;
  const PointCloudPtr cloud = feedUntilRevolution(assembler, sensor, budget);
  ASSERT_NE(cloud, nullptr);
  EXPECT_EQ(cloud->frame, "lidar");
  // 600 rpm: 0.1 s / 55.296 us = 1808 firing sequences of 16 points
  EXPECT_NEAR(static_cast<double>(cloud->size()), 1808 * 16, 32);
  EXPECT_LT(cloud->x.front(), 0.0f);  // starts and ends looking back
  EXPECT_NEAR(cloud->y.front(), 0.0f, 0.02f);
  EXPECT_LT(cloud->x.back(), 0.0f);
  EXPECT_NEAR(cloud->time_offset_s.back(), 0.1f, 2e-4f);
  EXPECT_NEAR(assembler.statistics().rpm, 600.0, 1.0);
  EXPECT_EQ(assembler.statistics().lost, 0u);
}

TEST(ScanAssembler, CountsLostPacketsAndGoesOn) {
  ScanAssembler assembler({});
  SyntheticSensor sensor;
  int budget = 400;
  ASSERT_NE(feedUntilRevolution(assembler, sensor, budget), nullptr);
  for (int i = 0; i < 5; ++i) (void)sensor.next();
  const PointCloudPtr holed = feedUntilRevolution(assembler, sensor, budget);
  ASSERT_NE(holed, nullptr);
  EXPECT_EQ(assembler.statistics().lost, 5u);
  EXPECT_NEAR(static_cast<double>(holed->size()), 1808 * 16 - 5 * 384, 48);
}

TEST(ScanAssembler, SurvivesTheFullHour) {
  ScanAssembler assembler({});
  SyntheticSensor sensor;
  sensor.time_us = 3'599'900'000u;
  double received = 0;
  int revolutions = 0;
  for (int i = 0; i < 400; ++i, received += 1327e-6) {
    Vlp16Packet packet = sensor.next();
    packet.timestamp_us %= 3'600'000'000u;
    auto cloud = assembler.feed(encodeVlp16Packet(packet), at(received));
    ASSERT_TRUE(cloud.has_value());
    if (*cloud != nullptr) ++revolutions;
  }
  EXPECT_GE(revolutions, 4);
  EXPECT_EQ(assembler.statistics().restarts, 0u);
  EXPECT_EQ(assembler.statistics().lost, 0u);
}

TEST(ScanAssembler, StampsFollowTheSensorNotTheNetworksJitter) {
  ScanAssembler assembler({});
  SyntheticSensor sensor;
  std::vector<Stamp> stamps;
  for (int i = 0; i < 800; ++i) {
    const double jitter = i % 7 == 3 ? 0.004 : 0.0;
    auto cloud = assembler.feed(encodeVlp16Packet(sensor.next()), at(i * 1327.1e-6 + jitter));
    if (cloud && *cloud != nullptr) stamps.push_back((*cloud)->stamp);
  }
  ASSERT_GE(stamps.size(), 6u);
  for (std::size_t i = 1; i < stamps.size(); ++i)
    EXPECT_NEAR(toSeconds(stamps[i] - stamps[i - 1]), 0.1, 2e-4);
}

TEST(ScanAssembler, CountsRefusedPackets) {
  ScanAssembler assembler({});
  const std::vector<std::uint8_t> junk(1206, 0xAA);
  EXPECT_FALSE(assembler.feed(junk, at(0)).has_value());
  EXPECT_EQ(assembler.statistics().refused, 1u);
}

}  // namespace
}  // namespace kiln::velodyne
