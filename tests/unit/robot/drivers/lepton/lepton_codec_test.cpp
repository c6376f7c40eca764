#include <fstream>

#include <gmock/gmock.h>

#include "robot/drivers/lepton/codec/base64.h"
#include "robot/drivers/lepton/codec/tjsn.h"
#include "robot/drivers/lepton/link/still_file.h"
#include "tests/support/data_dir.h"

namespace kiln::lepton {
namespace {

using ::testing::HasSubstr;

std::vector<std::uint16_t> telemetryWords() {
  std::vector<std::uint16_t> w(kTelemetryWords, 0);
  w[0] = 14;
  w[3] = 2 << 4 | 1 << 3;  // FFC running, desired
  w[20] = 59884;
  w[21] = 1;
  w[24] = 30613;
  w[208] = 1;
  w[209] = 1;
  return w;
}

TEST(LeptonTelemetry, ReadsItsWords) {
  const auto t = parseTelemetry(telemetryWords());
  ASSERT_TRUE(t.has_value()) << t.error();
  EXPECT_EQ(t->ffc, FfcState::Running);
  EXPECT_TRUE(t->ffc_desired);
  EXPECT_FALSE(t->agc);
  EXPECT_EQ(t->frame_counter, 65536u + 59884u);
  EXPECT_NEAR(t->fpa_k, 306.13, 1e-9);
  EXPECT_TRUE(t->tlinear);
  EXPECT_DOUBLE_EQ(t->kelvin_per_count, 0.01);
}

TEST(LeptonTelemetry, RefusesWhatIsNoTelemetry) {
  EXPECT_FALSE(parseTelemetry(std::vector<std::uint16_t>(kTelemetryWords, 0)).has_value());
  EXPECT_FALSE(parseTelemetry(std::vector<std::uint16_t>(kTelemetryWords - 1, 1)).has_value());
  auto words = telemetryWords();
  words[208] = 29500;  // pixels read as telemetry
  EXPECT_FALSE(parseTelemetry(words).has_value());
}

TEST(LeptonFrame, SplitsTheFooterOf160x122) {
  std::vector<std::uint16_t> words(160 * 122, 29500);
  const auto telemetry = telemetryWords();
  std::copy(telemetry.begin(), telemetry.end(), words.begin() + 160 * 120);
  const auto frame = splitFrame(160, 122, words);
  ASSERT_TRUE(frame.has_value()) << frame.error();
  EXPECT_EQ(frame->height, 120);
  EXPECT_EQ(frame->counts.size(), 160u * 120u);
  ASSERT_TRUE(frame->telemetry.has_value());
  EXPECT_TRUE(toThermalImage(*frame).tlinear);
}

TEST(LeptonFrame, WithoutTelemetryIsNotLinear) {
  const auto frame = splitFrame(160, 120, std::vector<std::uint16_t>(160 * 120, 29500));
  ASSERT_TRUE(frame.has_value());
  EXPECT_FALSE(toThermalImage(*frame).tlinear);
  EXPECT_FALSE(splitFrame(160, 120, std::vector<std::uint16_t>(7)).has_value());
}

TEST(Base64, DecodesWhatItEncodedAndRefusesTheRest) {
  for (std::size_t n = 0; n < 20; ++n) {
    std::vector<std::uint8_t> bytes(n);
    for (std::size_t i = 0; i < n; ++i) bytes[i] = static_cast<std::uint8_t>(37 * i + n);
    EXPECT_EQ(decodeBase64(encodeBase64(bytes)), bytes) << n;
  }
  for (const char* bad : {"a", "ab", "abc", "ab=c", "====", "a===", "ab c", "ab\n="}) {
    EXPECT_FALSE(decodeBase64(bad).has_value()) << bad;
  }
}

TEST(Tjsn, SaysWhatIsMissing) {
  EXPECT_THAT(parseTjsn("").error().message, HasSubstr("not valid JSON"));
  EXPECT_THAT(parseTjsn("[1,2]").error().message, HasSubstr("not valid JSON"));
  EXPECT_THAT(parseTjsn("{}").error().message, HasSubstr("no 'radiometric'"));
  EXPECT_THAT(parseTjsn(R"({"radiometric": "a"})").error().message, HasSubstr("not valid base64"));
  EXPECT_THAT(parseTjsn(R"({"radiometric": "AAAA"})").error().message,
              HasSubstr("has 3 bytes; needs 38400"));
}

TEST(Tjsn, ReadsTheRealFrames) {
  const auto off = kiln::testing::dataFile("lepton_tcam/agc_off.tjsn");
  const auto on = kiln::testing::dataFile("lepton_tcam/agc_on.tjsn");
  if (!off || !on) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  const auto linear = readStill(off->string());
  ASSERT_TRUE(linear.has_value()) << linear.error();
  const ThermalImage image = toThermalImage(*linear);
  EXPECT_TRUE(image.tlinear);
  EXPECT_FALSE(image.agc);
  const auto [coldest, hottest] = std::minmax_element(image.counts.begin(), image.counts.end());
  EXPECT_NEAR(*coldest * image.kelvin_per_count - 273.15, 2.1, 0.1);
  EXPECT_NEAR(*hottest * image.kelvin_per_count - 273.15, 65.5, 0.1);

  const ThermalImage agc = toThermalImage(*readStill(on->string()));
  EXPECT_TRUE(agc.agc);
  EXPECT_FALSE(agc.tlinear);
}

TEST(StillFile, RadiometricTiffOfAnotherCameraIsNotLinear) {
  const auto path = kiln::testing::dataFile("flirpy_thermal/example_radiometric.tiff");
  if (!path) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  const auto frame = readStill(path->string());
  ASSERT_TRUE(frame.has_value()) << frame.error();
  EXPECT_EQ(frame->width, 640);
  EXPECT_FALSE(toThermalImage(*frame).tlinear);
}

TEST(LeptonFrame, SaysWhyItHoldsNoTemperaturesAndWhatHelps) {
  LeptonFrame frame;
  EXPECT_NE(whyNoTemperatures(frame).find("record with telemetry"), std::string::npos);
  frame.telemetry.emplace();
  EXPECT_NE(whyNoTemperatures(frame).find("switch TLinear on"), std::string::npos);
  frame.telemetry->tlinear = true;
  EXPECT_EQ(whyNoTemperatures(frame), "");
  frame.telemetry->ffc = FfcState::Running;
  EXPECT_NE(whyNoTemperatures(frame).find("shutter was closed"), std::string::npos);
  frame.telemetry->agc = true;
  EXPECT_NE(whyNoTemperatures(frame).find("switch AGC off"), std::string::npos);
}

}  // namespace
}  // namespace kiln::lepton
