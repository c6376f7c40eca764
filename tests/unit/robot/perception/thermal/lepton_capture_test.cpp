#include <gmock/gmock.h>

#include "robot/drivers/lepton/link/still_file.h"
#include "robot/perception/thermal/heat_detector.h"
#include "tests/support/data_dir.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;

Result<HeatDetections> detectIn(const std::filesystem::path& file, double threshold_c) {
  const auto frame = lepton::readStill(file.string());
  if (!frame) return tl::make_unexpected(frame.error());
  HeatDetector::Config config;
  config.threshold_c = threshold_c;
  return HeatDetector(config).detect(lepton::toThermalImage(*frame));
}

TEST(LeptonCapture, HotMugIsFoundAndItsReflectionListedApart) {
  const auto file = testing::dataFile("lepton_tcam/agc_off.tjsn");
  if (!file) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  const auto found = detectIn(*file, 50.0);
  ASSERT_TRUE(found.has_value()) << found.error();
  ASSERT_TRUE(found->usable) << found->refusal;
  ASSERT_EQ(found->blobs.size(), 2u);
  const HeatBlob& mug = found->blobs[0];
  EXPECT_EQ(mug.rejection, HeatRejection::None);
  EXPECT_NEAR(mug.peak_k - 273.15, 65.0, 1.0);
  EXPECT_NEAR(mug.u, 130, 4);
  EXPECT_NEAR(mug.v, 40, 4);
  const HeatBlob& reflection = found->blobs[1];
  EXPECT_EQ(reflection.rejection, HeatRejection::Reflection) << reflection.reason;
  EXPECT_NEAR(reflection.u, mug.u, 5);
  EXPECT_GT(reflection.v, 68);
  EXPECT_NEAR(reflection.peak_k - 273.15, 41.0, 1.0);
}

TEST(LeptonCapture, ColdSceneHasNoSource) {
  const auto file = testing::dataFile("lepton_tcam/fox.tjsn");
  if (!file) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  const auto found = detectIn(*file, 50.0);
  ASSERT_TRUE(found.has_value()) << found.error();
  EXPECT_TRUE(found->usable);
  EXPECT_TRUE(found->blobs.empty());
  EXPECT_NEAR(found->max_k - 273.15, 8.9, 0.1);
}

TEST(LeptonCapture, AgcFrameAndForeignPicturesAreRefused) {
  const auto agc = testing::dataFile("lepton_tcam/agc_on.tjsn");
  const auto png = testing::dataFile("lepton_tcam/agc_off.png");
  const auto tiff = testing::dataFile("flirpy_thermal/example_radiometric.tiff");
  if (!agc || !png || !tiff) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  EXPECT_THAT(detectIn(*agc, 50)->refusal, HasSubstr("AGC is on"));
  EXPECT_THAT(detectIn(*png, 50)->refusal, HasSubstr("no TLinear telemetry"));
  EXPECT_THAT(detectIn(*tiff, 50)->refusal, HasSubstr("no TLinear telemetry"));
}

}  // namespace
}  // namespace kiln
