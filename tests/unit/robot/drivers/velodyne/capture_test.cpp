#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "robot/drivers/velodyne/device/capture_check.h"
#include "tests/support/data_dir.h"
#include "tests/support/synthetic_packets.h"

namespace kiln::velodyne {
namespace {

using ::testing::HasSubstr;

class CaptureTest : public ::testing::Test {
 protected:
  /// A file of this test's own, gone afterwards.
  std::string write(const std::string& name, const std::vector<char>& bytes) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("kiln_capture_" + std::to_string(::getpid()) + "_" + name);
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    written_.push_back(path);
    return path.string();
  }
  void TearDown() override {
    for (const auto& path : written_) std::filesystem::remove(path);
  }
  static std::vector<char> read(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static Result<CaptureSummary> check(const std::string& path) {
    auto file = openPacketFile(path);
    if (!file) return tl::make_unexpected(file.error());
    return checkCapture(**file, {});
  }
  static std::vector<char> syntheticRaw(int packets) {
    testing::SyntheticSensor sensor;
    std::vector<char> out;
    for (int i = 0; i < packets; ++i) {
      const auto bytes = encodeVlp16Packet(sensor.next());
      out.insert(out.end(), bytes.begin(), bytes.end());
    }
    return out;
  }

 private:
  std::vector<std::filesystem::path> written_;
};

TEST_F(CaptureTest, RawFilePlaysByItsOwnTimeStamps) {
  const auto summary = check(write("raw.bin", syntheticRaw(300)));
  ASSERT_TRUE(summary.has_value()) << summary.error();
  EXPECT_EQ(summary->data_packets, 300u);
  EXPECT_NEAR(toSeconds(summary->length), 299 * 1327e-6, 1e-3);
  EXPECT_EQ(summary->scan.lost, 0u);
}

TEST_F(CaptureTest, CutOffRawFileIsRefusedWithTheOffset) {
  auto bytes = syntheticRaw(300);
  bytes.resize(bytes.size() - 700);
  const auto summary = check(write("cut.bin", bytes));
  ASSERT_FALSE(summary.has_value());
  EXPECT_EQ(summary.error().code, ErrorCode::Truncated);
  EXPECT_THAT(summary.error().message,
              HasSubstr("cut off in packet 300 at byte 360594: 506 of 1206 bytes"));
}

TEST_F(CaptureTest, WhatIsNoCaptureIsRefused) {
  EXPECT_THAT(check("/nonexistent.pcap").error().message, HasSubstr("no such file"));
  EXPECT_THAT(check("/").error().message, HasSubstr("not a file"));
  EXPECT_THAT(check(write("empty.pcap", {})).error().message, HasSubstr("has only 0 bytes"));
  EXPECT_THAT(check(write("text.pcap", {'h', 'e', 'l', 'l', 'o'})).error().message,
              HasSubstr("neither a pcap capture"));
  EXPECT_THAT(check(write("short.bin", syntheticRaw(20))).error().message,
              HasSubstr("less than one full revolution"));
}

TEST_F(CaptureTest, MrptCaptureHasItsPackets) {
  const auto path = kiln::testing::dataFile("mrpt_velodyne/sample_velodyne_vlp16_gps.pcap");
  if (!path) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  const auto summary = check(path->string());
  ASSERT_TRUE(summary.has_value()) << summary.error();
  EXPECT_EQ(summary->data_packets, 293u);
  EXPECT_EQ(summary->position_packets, 57u);
  EXPECT_EQ(summary->mode, ReturnMode::Strongest);
  EXPECT_NEAR(summary->scan.rpm, 599.0, 1.5);
  EXPECT_EQ(summary->scan.lost, 0u);
  ASSERT_TRUE(summary->position.has_value());
  EXPECT_EQ(summary->position->pps, PpsStatus::Locked);
  EXPECT_TRUE(summary->position->nmea_valid);
}

TEST_F(CaptureTest, HdlCaptureIsRefusedByName) {
  const auto path = kiln::testing::dataFile("mrpt_velodyne/sample_velodyne_hdl32.pcap");
  if (!path) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  const auto summary = check(path->string());
  ASSERT_FALSE(summary.has_value());
  EXPECT_THAT(summary.error().message,
              HasSubstr("from an HDL-32E (product 0x21); this input needs a VLP-16"));
  EXPECT_THAT(summary.error().message, HasSubstr("sample_velodyne_hdl32.pcap"));
}

TEST_F(CaptureTest, CutOffPcapIsRefusedAtEveryPlace) {
  const auto path = kiln::testing::dataFile("mrpt_velodyne/sample_velodyne_vlp16_gps.pcap");
  if (!path) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  const auto whole = read(*path);
  for (const std::size_t n :
       {std::size_t{10}, std::size_t{30}, std::size_t{60}, whole.size() / 2, whole.size() - 1}) {
    const auto summary =
        check(write("cut.pcap", {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n)}));
    ASSERT_FALSE(summary.has_value()) << n;
    EXPECT_THAT(summary.error().message, HasSubstr("cut.pcap")) << n;
    EXPECT_THAT(summary.error().message,
                ::testing::AnyOf(HasSubstr("at byte"), HasSubstr("not a readable capture")))
        << n;
  }
}

}  // namespace
}  // namespace kiln::velodyne
