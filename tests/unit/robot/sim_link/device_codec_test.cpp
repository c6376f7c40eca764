#include "robot/sim_link/device_codec.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(DeviceCodec, ScanWithArraysOfDifferentLengthIsRefused) {
  v1::device::LidarScan scan;
  scan.set_ring(std::string(3, '\1'));
  scan.set_intensity(std::string(3, '\1'));
  scan.set_time_offset_f32(std::string(12, '\0'));
  scan.set_xyz_f32(std::string(36, '\0'));
  EXPECT_TRUE(cloudFromProto(scan, {}).has_value());
  scan.set_xyz_f32(std::string(35, '\0'));
  EXPECT_FALSE(cloudFromProto(scan, {}).has_value());
}

TEST(DeviceCodec, ImagesOfTheWrongSizeAreRefused) {
  v1::device::ThermalFrame thermal;
  thermal.set_counts_u16(std::string(160 * 120 * 2 - 1, '\0'));
  EXPECT_FALSE(thermalFromProto(thermal, {}).has_value());
  v1::device::ColourFrame colour;
  colour.set_width(0xffffffff);
  colour.set_height(0xffffffff);
  colour.set_rgb("abc");
  EXPECT_FALSE(colourFromProto(colour, "rgb", {}).has_value());
  EXPECT_FALSE(colourFromProto({}, "rgb", {}).has_value());
}

TEST(DeviceCodec, ReportsWithMissingJointsOrWheelsAreRefused) {
  v1::device::Report report;
  EXPECT_FALSE(armFromProto(report, {}).has_value());
  EXPECT_FALSE(baseFromProto(report, {}).has_value());
  EXPECT_FALSE(pumpsFromProto(report, {}).has_value());
}

TEST(DeviceCodec, StampsAreShiftedToTheDaemonsClock) {
  v1::device::ThermalFrame thermal;
  thermal.set_counts_u16(std::string(160 * 120 * 2, '\0'));
  thermal.set_stamp_ns(1000);
  const auto image = thermalFromProto(thermal, Duration{500});
  ASSERT_TRUE(image.has_value());
  EXPECT_EQ(toNanoseconds((*image)->stamp), 1500);
}

}  // namespace
}  // namespace kiln
